// What the sources of the compiled code for boxes of triangles share: vectors, and the tree as it crosses the border.

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#if defined(_WIN32)
#define PROXIMITY_API extern "C" __declspec(dllexport)
#else
#define PROXIMITY_API extern "C" __attribute__((visibility("default")))
#endif

namespace {

struct Vec {
    double x, y, z;
};

// A box along the axes of what it holds: its middle, its axes as unit vectors, and half of its length along each.
struct Oriented {
    Vec middle, axes[3];
    double half[3];
};

// What crosses the border; native.py declares the same. A node has `link[2]` triangles, from place `link[1]` of `order`
// on; an inner one's children are `link[0]` and the one after it, a leaf has -1 there. `oriented` and `states` are filled
// as they are needed, by whoever comes first: see `oriented_box`.
struct BoxTree {
    const double* triangles;  // (n, 3, 3)
    const int32_t* order;     // (n,)
    const double* boxes;      // (nodes, 6): low, high
    const int32_t* links;     // (nodes, 3)
    Oriented* oriented;       // (nodes,), 15 numbers each
    uint8_t* states;          // (nodes,)
    int64_t nodes;
};

constexpr double INFINITE = std::numeric_limits<double>::infinity();

inline Vec at(const double* p) { return {p[0], p[1], p[2]}; }
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double part(Vec v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

inline void corners_of(const BoxTree& tree, int32_t triangle, Vec* t) {
    const double* from = tree.triangles + 9 * int64_t(triangle);
    for (int k = 0; k < 3; ++k) t[k] = at(from + 3 * k);
}

}  // namespace
