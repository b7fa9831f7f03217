// Limit evaluation by OpenSubdiv, for comparison. Each run does one task and prints one line of JSON.

#include "bfr.h"
#include "cage.h"
#include "far.h"

#include <opensubdiv/version.h>

#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <iostream>

namespace {

char const *const USAGE =
    "usage: opensubdiv_limit version\n"
    "       opensubdiv_limit setup     PEER LEVEL CAGE\n"
    "       opensubdiv_limit faces     PEER LEVEL CAGE ORDER SIDE\n"
    "       opensubdiv_limit scattered PEER LEVEL CAGE ORDER SAMPLES\n"
    "       opensubdiv_limit values    PEER LEVEL CAGE ORDER SAMPLES OUTPUT\n"
    "PEER: bfr (surfaces on demand), bfr-prepared, far. LEVEL: of isolation; -1 is the default.\n"
    "ORDER: of derivatives, 1 or 2. SIDE: so many samples along u and v of each face.\n";

// Face by face, results go round in a buffer of this many points: a user takes them away as they come.
constexpr std::size_t BLOCK = 4096;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What the process holds in memory, without what it has given back to the allocator.
double residentBytes() {
    malloc_trim(0);
    long total = 0, resident = 0;
    std::FILE *file = std::fopen("/proc/self/statm", "r");
    if (!file) return 0;
    int const read = std::fscanf(file, "%ld %ld", &total, &resident);
    std::fclose(file);
    return read == 2 ? double(resident) * double(sysconf(_SC_PAGESIZE)) : 0;
}

// The bits of all results, so that two runs can be told apart.
struct Checksum {
    std::uint64_t value = 14695981039346656037u;

    void add(double const *numbers, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            std::uint64_t bits;
            std::memcpy(&bits, numbers + i, sizeof bits);
            value = (value ^ bits) * 1099511628211u;
        }
    }
};

struct Report {
    std::size_t points = 0;
    // Of preparation: face by face also part of `seconds`.
    double prepareSeconds = 0;
    double seconds = 0;
    std::uint64_t checksum = 0;
};

// All faces in order, `side` x `side` cell centres in each, preparation included.
template <typename Peer>
Report byFaces(Cage const &cage, Far::TopologyRefiner &refiner, int level, int order, int side) {
    std::size_t const width = 9 * std::size_t(order);
    std::vector<double> block(BLOCK * width);
    auto pass = [&](Report &report, auto &&take) {
        double const start = now();
        Peer peer(level);
        peer.prepare(cage, refiner);
        report.prepareSeconds = now() - start;
        std::size_t filled = 0;
        for (int face = 0; face < cage.faceCount(); ++face) {
            for (int j = 0; j < side; ++j) {
                for (int i = 0; i < side; ++i) {
                    Sample const at = {face, -1, (i + 0.5) / side, (j + 0.5) / side};
                    peer.evaluate(at, order, &block[width * filled]);
                    if (++filled == BLOCK) {
                        take(filled);
                        filled = 0;
                    }
                }
            }
        }
        take(filled);
        report.seconds = now() - start;
    };
    Report report;
    Checksum checksum;
    pass(report, [&](std::size_t count) { checksum.add(block.data(), count * width); });
    pass(report, [](std::size_t) {});
    report.points = std::size_t(cage.faceCount()) * std::size_t(side) * std::size_t(side);
    report.checksum = checksum.value;
    return report;
}

// A list of samples in its order, into memory that has been written to before.
template <typename Peer>
Report byList(Cage const &cage, Far::TopologyRefiner &refiner, int level, int order,
              std::vector<Sample> const &samples, std::vector<double> &results) {
    std::size_t const width = 9 * std::size_t(order);
    results.resize(samples.size() * width);
    Report report;
    report.points = samples.size();
    double const start = now();
    Peer peer(level);
    peer.prepare(cage, refiner);
    report.prepareSeconds = now() - start;
    for (int pass = 0; pass < 2; ++pass) {
        double const begin = now();
        for (std::size_t i = 0; i < samples.size(); ++i) peer.evaluate(samples[i], order, &results[i * width]);
        report.seconds = now() - begin;
    }
    Checksum checksum;
    checksum.add(results.data(), results.size());
    report.checksum = checksum.value;
    return report;
}

void print(Report const &report) {
    std::cout.precision(9);
    std::cout << "{\"points\":" << report.points << ",\"seconds\":" << report.seconds
              << ",\"prepare_seconds\":" << report.prepareSeconds << ",\"checksum\":\"" << report.checksum << "\"}\n";
}

template <typename Peer>
void setUp(Cage const &cage, int level) {
    double const before = residentBytes();
    double const start = now();
    std::unique_ptr<Far::TopologyRefiner> const refiner = connect(cage);
    double const connectSeconds = now() - start;
    double const connected = residentBytes();
    double const begin = now();
    Peer peer(level);
    peer.prepare(cage, *refiner);
    double const prepareSeconds = now() - begin;
    double const prepared = residentBytes();
    std::cout << "{\"connect_seconds\":" << connectSeconds << ",\"prepare_seconds\":" << prepareSeconds
              << ",\"connect_bytes\":" << std::int64_t(connected - before)
              << ",\"prepare_bytes\":" << std::int64_t(prepared - connected) << "}\n";
}

template <typename Peer>
void run(std::string const &task, int level, std::vector<std::string> const &rest) {
    Cage const cage = readCage(rest.at(0));
    if (task == "setup") return setUp<Peer>(cage, level);
    std::unique_ptr<Far::TopologyRefiner> const refiner = connect(cage);
    int const order = std::stoi(rest.at(1));
    if (task == "faces") {
        return print(byFaces<Peer>(cage, *refiner, level, order, std::stoi(rest.at(2))));
    }
    std::vector<double> results;
    Report const report = byList<Peer>(cage, *refiner, level, order, readSamples(rest.at(2)), results);
    if (task == "values") {
        std::FILE *file = std::fopen(rest.at(3).c_str(), "wb");
        if (!file) throw std::runtime_error("cannot write " + rest.at(3));
        std::size_t const written = std::fwrite(results.data(), sizeof(double), results.size(), file);
        if (std::fclose(file) != 0 || written != results.size()) throw std::runtime_error("cannot write values");
    }
    print(report);
}

}  // namespace

int main(int argc, char **argv) {
    std::vector<std::string> const arguments(argv + 1, argv + argc);
    try {
        std::string const task = arguments.empty() ? "" : arguments[0];
        if (task == "version") {
            std::cout << OPENSUBDIV_VERSION_NUMBER / 10000 << '.' << OPENSUBDIV_VERSION_NUMBER / 100 % 100 << '.'
                      << OPENSUBDIV_VERSION_NUMBER % 100 << '\n';
            return 0;
        }
        if (task != "setup" && task != "faces" && task != "scattered" && task != "values") {
            std::cerr << USAGE;
            return 2;
        }
        std::string const peer = arguments.at(1);
        int const level = std::stoi(arguments.at(2));
        std::vector<std::string> const rest(arguments.begin() + 3, arguments.end());
        if (peer == "bfr") {
            run<BfrOnDemand>(task, level, rest);
        } else if (peer == "bfr-prepared") {
            run<BfrPrepared>(task, level, rest);
        } else if (peer == "far") {
            run<FarTable>(task, level, rest);
        } else {
            throw std::runtime_error("no such peer: " + peer);
        }
    } catch (std::exception const &error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
