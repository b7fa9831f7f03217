// What the machine itself can do with so many bytes: the times that no program can be faster than. Bytes are written
// by plain stores and by the C library, and the quicker one counts.

#include "measure.h"

#include <sys/mman.h>

#include <functional>
#include <thread>

namespace {

// The same work on shares of the memory, one a thread.
void onThreads(std::size_t threads, std::size_t words, std::function<void(std::size_t, std::size_t)> const &work) {
    std::vector<std::thread> others;
    for (std::size_t t = 1; t < threads; ++t) {
        others.emplace_back(work, words * t / threads, words * (t + 1) / threads);
    }
    work(0, words / threads);
    for (std::thread &other : others) other.join();
}

double timed(std::function<void()> const &task) {
    double const start = now();
    task();
    return now() - start;
}

class Memory {
public:
    explicit Memory(std::size_t bytes, bool large = false) : bytes(bytes) {
        address = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (address == MAP_FAILED) throw std::bad_alloc();
        madvise(address, bytes, large ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
    }
    ~Memory() { munmap(address, bytes); }
    Memory(Memory const &) = delete;
    Memory &operator=(Memory const &) = delete;
    std::uint64_t *words() { return static_cast<std::uint64_t *>(address); }

private:
    std::size_t bytes;
    void *address;
};

// Without being recognised as a `memset`.
__attribute__((noinline, optimize("no-tree-loop-distribute-patterns"))) void store(std::uint64_t *words, std::size_t from,
                                                                                 std::size_t to, std::uint64_t value) {
    for (std::size_t i = from; i < to; ++i) words[i] = value;
}

double writeSeconds(std::uint64_t *words, std::size_t count, std::size_t threads) {
    double best = 1e300;
    for (std::uint64_t pass = 1; pass < 4; ++pass) {
        double const stores = timed([&] {
            onThreads(threads, count, [&](std::size_t from, std::size_t to) { store(words, from, to, pass); });
        });
        double const library = timed([&] {
            onThreads(threads, count,
                      [&](std::size_t from, std::size_t to) { std::memset(words + from, int(pass), 8 * (to - from)); });
        });
        best = std::min({best, stores, library});
    }
    return best;
}

double readSeconds(std::uint64_t const *words, std::size_t count, std::size_t threads) {
    double best = 1e300;
    for (int pass = 0; pass < 3; ++pass) {
        best = std::min(best, timed([&] {
            onThreads(threads, count, [&](std::size_t from, std::size_t to) {
                std::uint64_t sum = 0;
                for (std::size_t i = from; i < to; ++i) sum += words[i];
                volatile std::uint64_t const kept = sum;
                (void)kept;
            });
        }));
    }
    return best;
}

double freshSeconds(std::size_t bytes, std::size_t threads, bool large) {
    Memory memory(bytes, large);
    return timed([&] {
        onThreads(threads, bytes / 8, [&](std::size_t from, std::size_t to) { store(memory.words(), from, to, 1); });
    });
}

}  // namespace

int main(int argc, char **argv) {
    if (argc == 2 && std::string(argv[1]) == "version") {
        std::cout << "1\n";
        return 0;
    }
    if (argc < 4) {
        std::cerr << "usage: machine_limits TASK BYTES THREADS [CAGE]\n"
                     "TASK and CAGE are there because other programs have them.\n";
        return 2;
    }
    std::size_t const bytes = std::stoul(argv[2]), threads = std::stoul(argv[3]);
    double const fresh = freshSeconds(bytes, threads, false);
    double const freshLarge = freshSeconds(bytes, threads, true);
    Memory memory(bytes);
    store(memory.words(), 0, bytes / 8, 0);
    std::cout << "{\"fresh_seconds\":" << fresh << ",\"fresh_large_seconds\":" << freshLarge
              << ",\"reused_seconds\":" << writeSeconds(memory.words(), bytes / 8, threads)
              << ",\"read_seconds\":" << readSeconds(memory.words(), bytes / 8, threads) << "}\n";
}
