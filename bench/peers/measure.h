// What every program of the refinement benchmark measures, in the same way: passes, memory, and figures of the result
// that do not depend on the order of its vertices. `bench/refine/src/measure.rs` is the same in Rust.

#pragma once

#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

inline double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Room for numbers that is not written to before its owner does; a `std::vector` clears it first.
template <typename T>
class Buffer {
public:
    Buffer() = default;
    ~Buffer() { std::free(values); }
    Buffer(Buffer const &) = delete;
    Buffer &operator=(Buffer const &) = delete;

    void resize(std::size_t wanted) {
        if (wanted > capacity) {
            std::free(values);
            values = static_cast<T *>(std::malloc(wanted * sizeof(T)));
            if (!values) throw std::bad_alloc();
            capacity = wanted;
        }
        count = wanted;
    }
    T *data() { return values; }
    T const *data() const { return values; }
    std::size_t size() const { return count; }
    T &operator[](std::size_t i) { return values[i]; }
    T const &operator[](std::size_t i) const { return values[i]; }

private:
    T *values = nullptr;
    std::size_t count = 0, capacity = 0;
};

// A line of /proc/self/status in bytes.
inline double statusBytes(char const *key) {
    std::FILE *file = std::fopen("/proc/self/status", "r");
    if (!file) throw std::runtime_error("no /proc/self/status");
    char line[256];
    double kilobytes = 0;
    while (std::fgets(line, sizeof line, file)) {
        if (std::strncmp(line, key, std::strlen(key)) == 0) kilobytes = std::atof(line + std::strlen(key) + 1);
    }
    std::fclose(file);
    return kilobytes * 1024;
}

// Peak of resident memory over what is resident now.
class Peak {
public:
    Peak() {
        malloc_trim(0);
        std::FILE *file = std::fopen("/proc/self/clear_refs", "w");
        if (file) {
            std::fputs("5", file);
            std::fclose(file);
        }
        before = statusBytes("VmRSS");
    }
    double growth() const { return statusBytes("VmHWM") - before; }

private:
    double before;
};

struct Passes {
    double freshSeconds, reusedSeconds, peakBytes;
};

// The task three times: into fresh memory, and twice into the same again, of which the last counts.
template <typename Task>
Passes passes(Task &&task) {
    Passes result;
    Peak const peak;
    double start = now();
    task();
    result.freshSeconds = now() - start;
    result.peakBytes = peak.growth();
    for (int pass = 0; pass < 2; ++pass) {
        start = now();
        task();
        result.reusedSeconds = now() - start;
    }
    return result;
}

// Means of the coordinates and of their products, area and volume: all there is to a mesh but its order.
template <typename Points, typename Corners>
std::array<double, 11> figures(Points const &points, std::size_t pointCount, Corners const &corners,
                               std::size_t faceCount) {
    std::array<double, 11> sums{};
    for (std::size_t i = 0; i < pointCount; ++i) {
        double const x = points[3 * i], y = points[3 * i + 1], z = points[3 * i + 2];
        double const terms[9] = {x, y, z, x * x, y * y, z * z, x * y, y * z, z * x};
        for (int k = 0; k < 9; ++k) sums[k] += terms[k] / double(pointCount);
    }
    for (std::size_t f = 0; f < faceCount; ++f) {
        double p[4][3], a[3], b[3];
        for (int k = 0; k < 4; ++k) {
            for (int c = 0; c < 3; ++c) p[k][c] = points[3 * std::size_t(corners[4 * f + k]) + c];
        }
        for (int c = 0; c < 3; ++c) {
            a[c] = p[2][c] - p[0][c];
            b[c] = p[3][c] - p[1][c];
        }
        double const n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        sums[9] += std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
        for (int c = 0; c < 3; ++c) sums[10] += n[c] * (p[0][c] + p[1][c] + p[2][c] + p[3][c]) / 24;
    }
    return sums;
}

inline void printFigures(std::size_t vertices, std::size_t faces, std::array<double, 11> const &figures) {
    std::cout.precision(17);
    std::cout << "\"vertices\":" << vertices << ",\"faces\":" << faces << ",\"figures\":[";
    for (int k = 0; k < 11; ++k) std::cout << (k ? "," : "") << figures[k];
    std::cout << "]";
}

template <typename Points, typename Corners>
void printRefinement(Passes const &passes, Points const &points, Corners const &corners) {
    std::size_t const vertices = points.size() / 3, faces = corners.size() / 4;
    std::cout << "{";
    printFigures(vertices, faces, figures(points, vertices, corners, faces));
    std::cout << ",\"fresh_seconds\":" << passes.freshSeconds << ",\"reused_seconds\":" << passes.reusedSeconds
              << ",\"peak_bytes\":" << passes.peakBytes << "}\n";
}

// The cage in the pose of a frame: sheared, more from frame to frame.
template <typename T>
void pose(std::vector<double> const &points, int frame, int stride, std::vector<T> &out) {
    double const shear = double(frame) / 16;
    out.assign(points.size() / 3 * std::size_t(stride), T(0));
    for (std::size_t i = 0; i < points.size() / 3; ++i) {
        out[stride * i] = T(points[3 * i] + shear * points[3 * i + 1]);
        out[stride * i + 1] = T(points[3 * i + 1]);
        out[stride * i + 2] = T(points[3 * i + 2]);
    }
}

// The median time of so many poses, after one that brings memory; `apply` is given the posed cage.
template <typename T, typename Apply>
double animate(std::vector<double> const &points, int frames, int stride, Apply &&apply) {
    std::vector<T> posed;
    std::vector<double> times;
    for (int frame = 0; frame <= frames; ++frame) {
        pose(points, frame, stride, posed);
        double const start = now();
        apply(posed);
        if (frame > 0) times.push_back(now() - start);
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}
