// Cages and lists of samples as the benchmarks hand them over.

#pragma once

#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

// Little-endian values, read in the order in which they were written.
class Reader {
public:
    explicit Reader(std::string const &path) : file(std::fopen(path.c_str(), "rb")) {
        if (!file) throw std::runtime_error("cannot read " + path);
    }
    ~Reader() { std::fclose(file); }
    Reader(Reader const &) = delete;
    Reader &operator=(Reader const &) = delete;

    template <typename T>
    std::vector<T> list(std::size_t count) {
        std::vector<T> values(count);
        if (std::fread(values.data(), sizeof(T), count, file) != count) {
            throw std::runtime_error("a file ends too early");
        }
        return values;
    }

private:
    std::FILE *file;
};

struct Cage {
    std::vector<double> points;
    std::vector<int> faceSizes, corners;
    std::vector<int> creaseVertices, sharpVertices;
    std::vector<float> creaseSharpness, vertexSharpness;
    bool sharpCorners = true;

    int faceCount() const { return static_cast<int>(faceSizes.size()); }
    int vertexCount() const { return static_cast<int>(points.size() / 3); }
};

inline Cage readCage(std::string const &path) {
    Reader reader(path);
    std::vector<std::uint32_t> const header = reader.list<std::uint32_t>(6);
    Cage cage;
    cage.points = reader.list<double>(3 * std::size_t(header[0]));
    cage.faceSizes = reader.list<int>(header[1]);
    cage.corners = reader.list<int>(header[2]);
    cage.creaseVertices = reader.list<int>(2 * std::size_t(header[3]));
    cage.creaseSharpness = reader.list<float>(header[3]);
    cage.sharpVertices = reader.list<int>(header[4]);
    cage.vertexSharpness = reader.list<float>(header[4]);
    cage.sharpCorners = header[5] == 0;
    return cage;
}

// A place on the surface. `corner` counts from 0 on a face that is no quad, and is -1 on a quad.
struct Sample {
    std::int32_t face, corner;
    double u, v;
};

inline std::vector<Sample> readSamples(std::string const &path) {
    Reader reader(path);
    std::uint64_t const count = reader.list<std::uint64_t>(1)[0];
    return reader.list<Sample>(count);
}
