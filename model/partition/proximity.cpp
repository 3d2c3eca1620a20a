// A tree of boxes over triangles, compiled: building it, the distance of two surfaces, the nearest points of a surface,
// and how often it winds round points. The same as model/proximity has it in NumPy; boxes.py there says what the arrays
// hold, native.py calls this through ctypes. The rules of bsp.cpp hold here, too.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#if defined(_WIN32)
#define PROXIMITY_API extern "C" __declspec(dllexport)
#else
#define PROXIMITY_API extern "C" __attribute__((visibility("default")))
#endif

namespace {

// What crosses the border; native.py declares the same. An inner node's children are `link[0]` and the one after it; a
// leaf has `link[1]` triangles, from place `link[0]` of `order` on.
struct BoxTree {
    const double* triangles;  // (n, 3, 3)
    const int32_t* order;     // (n,)
    const double* boxes;      // (nodes, 6): low, high
    const int32_t* links;     // (nodes, 2)
    int64_t nodes;
};

constexpr int LEAF = 2;
constexpr double INFINITE = std::numeric_limits<double>::infinity();

struct Vec {
    double x, y, z;
};

inline Vec at(const double* p) { return {p[0], p[1], p[2]}; }
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

// The nearest pair of points found so far, the triangles that they are on, and the unit vector from one to the other; at
// first the limit, and a direction from the first surface to the second.
struct Best {
    double square;
    Vec a, b;
    int32_t one, other;
    Vec along;
};

inline bool offer(Best& best, Vec a, Vec b) {
    const Vec way = b - a;
    const double square = dot(way, way);
    if (!(square < best.square)) return false;
    best.square = square;
    best.a = a;
    best.b = b;
    return true;
}

Vec on_segment(Vec p, Vec a, Vec b) {
    const Vec way = b - a;
    const double square = dot(way, way);
    const double part = square > 0.0 ? dot(p - a, way) / square : 0.0;
    return a + std::min(std::max(part, 0.0), 1.0) * way;
}

// The foot where it lies within, else the nearest point of the sides (Ericson 2005, chapter 5).
Vec on_triangle(Vec p, const Vec* t) {
    const Vec u = t[1] - t[0], v = t[2] - t[0], normal = cross(u, v);
    const double square = dot(normal, normal), longest = std::max(dot(u, u), dot(v, v));
    if (square > 1e-30 * longest * longest) {
        const Vec foot = p - (dot(p - t[0], normal) / square) * normal;
        bool within = true;
        for (int k = 0; k < 3 && within; ++k) {
            const Vec a = t[k], b = t[(k + 1) % 3];
            within = dot(cross(b - a, foot - a), normal) >= 0.0;
        }
        if (within) return foot;
    }
    Vec nearest = t[0];
    double least = INFINITE;
    for (int k = 0; k < 3; ++k) {
        const Vec q = on_segment(p, t[k], t[(k + 1) % 3]), way = q - p;
        const double gap = dot(way, way);
        if (gap < least) {
            least = gap;
            nearest = q;
        }
    }
    return nearest;
}

// The nearest points of two sides, where both lie between their ends; what lies at an end is found from the corners.
bool between(Vec a, Vec u, Vec b, Vec v, Vec& near_a, Vec& near_b) {
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v);
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-12 * uu * vv)) return false;
    const Vec gap = b - a;
    const double ug = dot(u, gap), vg = dot(v, gap);
    const double s = (ug * vv - vg * uv) / determinant, t = (ug * uv - vg * uu) / determinant;
    if (!(s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)) return false;
    near_a = a + s * u;
    near_b = b + t * v;
    return true;
}

// Whether a segment passes through a triangle, and where (Moeller and Trumbore 1997).
bool pierced(Vec start, Vec way, const Vec* t, Vec& where) {
    const Vec first = t[1] - t[0], second = t[2] - t[0];
    const Vec across = cross(way, second), normal = cross(first, second);
    const double determinant = dot(first, across);
    if (!(std::fabs(determinant) > 1e-14 * std::sqrt(dot(normal, normal) * dot(way, way)))) return false;
    const Vec offset = start - t[0], turned = cross(offset, first);
    const double u = dot(offset, across) / determinant, v = dot(way, turned) / determinant;
    const double part = dot(second, turned) / determinant;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && part >= 0.0 && part <= 1.0)) return false;
    where = start + part * way;
    return true;
}

// The nearest points lie at a corner of one triangle, on a side of each, or where one is pierced.
bool nearest_of(const Vec* one, const Vec* other, Best& best) {
    bool found = false;
    for (int i = 0; i < 3; ++i) {
        found |= offer(best, one[i], on_triangle(one[i], other));
        found |= offer(best, on_triangle(other[i], one), other[i]);
        const Vec u = one[(i + 1) % 3] - one[i];
        for (int j = 0; j < 3; ++j) {
            Vec a, b;
            if (between(one[i], u, other[j], other[(j + 1) % 3] - other[j], a, b)) found |= offer(best, a, b);
        }
    }
    if (best.square == 0.0) return found;
    const Vec* sides[2] = {one, other};
    for (int k = 0; k < 2; ++k) {
        const Vec *these = sides[k], *those = sides[1 - k];
        const Vec normal = cross(those[1] - those[0], those[2] - those[0]);
        int before = 0, behind = 0;
        for (int i = 0; i < 3; ++i) {
            const double height = dot(these[i] - those[0], normal);
            before += height >= 0.0;
            behind += height <= 0.0;
        }
        if (before == 0 || behind == 0) return found;  // on one side of the other's plane
        for (int i = 0; i < 3; ++i) {
            Vec where;
            if (pierced(these[i], these[(i + 1) % 3] - these[i], those, where)) return offer(best, where, where) || found;
        }
    }
    return found;
}

inline double gap_to(const double* box, Vec p) {
    const double point[3] = {p.x, p.y, p.z};
    double square = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double gap = std::max(box[k] - point[k], point[k] - box[3 + k]);
        if (gap > 0.0) square += gap * gap;
    }
    return square;
}

inline double size_of(const double* box) {
    return std::max(std::max(box[3] - box[0], box[4] - box[1]), box[5] - box[2]);
}

inline void corners_of(const BoxTree& tree, int32_t triangle, Vec* t) {
    const double* from = tree.triangles + 9 * int64_t(triangle);
    for (int k = 0; k < 3; ++k) t[k] = at(from + 3 * k);
}

struct Pair {
    double square, between;  // of the boxes' gap, and of the way from middle to middle
    int32_t one, other;
};

inline Pair pair_of(const BoxTree& one, const BoxTree& other, int32_t i, int32_t j) {
    const double *box = one.boxes + 6 * int64_t(i), *counter = other.boxes + 6 * int64_t(j);
    double square = 0.0, between = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double gap = std::max(box[k] - counter[3 + k], counter[k] - box[3 + k]);
        if (gap > 0.0) square += gap * gap;
        const double way = box[k] + box[3 + k] - counter[k] - counter[3 + k];
        between += way * way;
    }
    return {square, between, i, j};
}

// The triangles of two leaves, but for those that a slab across the best way keeps as far apart as it is long: most.
void leaves(const BoxTree& one, const BoxTree& other, int32_t i, int32_t j, Best& best) {
    const int32_t *a = one.links + 2 * int64_t(i), *b = other.links + 2 * int64_t(j);
    for (int32_t m = 0; m < a[1]; ++m) {
        const int32_t left = one.order[a[0] + m];
        Vec t[3];
        corners_of(one, left, t);
        for (int32_t n = 0; n < b[1]; ++n) {
            const int32_t right = other.order[b[0] + n];
            Vec s[3];
            corners_of(other, right, s);
            const Vec way = best.along;
            const double ends = std::max(std::max(dot(way, t[0]), dot(way, t[1])), dot(way, t[2]));
            const double begins = std::min(std::min(dot(way, s[0]), dot(way, s[1])), dot(way, s[2]));
            const double apart = begins - ends;
            if (apart > 0.0 && apart * apart >= best.square) continue;
            if (!nearest_of(t, s, best)) continue;
            best.one = left;
            best.other = right;
            if (best.square == 0.0) return;
            best.along = (1.0 / std::sqrt(best.square)) * (best.b - best.a);
        }
    }
}

// From the pair of roots down, the nearer boxes first; pairs that are farther apart than what was found are left out.
void descend(const BoxTree& one, const BoxTree& other, Best& best) {
    std::vector<Pair> waiting;
    waiting.push_back(pair_of(one, other, 0, 0));
    while (!waiting.empty() && best.square > 0.0) {
        const Pair pair = waiting.back();
        waiting.pop_back();
        if (!(pair.square < best.square)) continue;
        const bool leaf = one.links[2 * int64_t(pair.one) + 1] > 0, end = other.links[2 * int64_t(pair.other) + 1] > 0;
        if (leaf && end) {
            leaves(one, other, pair.one, pair.other, best);
            continue;
        }
        const double *box = one.boxes + 6 * int64_t(pair.one), *counter = other.boxes + 6 * int64_t(pair.other);
        const bool opens = end || (!leaf && size_of(box) >= size_of(counter));
        const int32_t child = opens ? one.links[2 * int64_t(pair.one)] : other.links[2 * int64_t(pair.other)];
        Pair parts[2];
        for (int k = 0; k < 2; ++k) {
            const int32_t i = opens ? child + k : pair.one, j = opens ? pair.other : child + k;
            parts[k] = pair_of(one, other, i, j);
        }
        const bool same = parts[0].square == parts[1].square;
        if (same ? parts[0].between < parts[1].between : parts[0].square < parts[1].square) std::swap(parts[0], parts[1]);
        for (const Pair& part : parts)
            if (part.square < best.square) waiting.push_back(part);
    }
}

// On which side of the line from a to b, seen from above, a point lies: 1 on the left. One that lies on it is moved by
// (e, e * e) for a tiny e. Two triangles with this side get the same answer, whichever way they have it.
inline int side_of(Vec a, Vec b, double x, double y) {
    int sign = 1;
    if (a.x > b.x || (a.x == b.x && (a.y > b.y || (a.y == b.y && a.z > b.z)))) {
        std::swap(a, b);
        sign = -1;
    }
    const double turn = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    if (turn != 0.0) return turn > 0.0 ? sign : -sign;
    if (b.y != a.y) return b.y > a.y ? -sign : sign;
    return sign;  // b.x > a.x; sides that are points lie beside everything alike
}

int32_t winding(const BoxTree& tree, Vec p, std::vector<int32_t>& waiting) {
    int32_t found = 0;
    waiting.assign(1, 0);
    while (!waiting.empty()) {
        const int64_t node = waiting.back();
        waiting.pop_back();
        const double* box = tree.boxes + 6 * node;
        if (p.x < box[0] || p.x > box[3] || p.y < box[1] || p.y > box[4] || p.z > box[5]) continue;
        const int32_t* link = tree.links + 2 * node;
        if (link[1] == 0) {
            waiting.push_back(link[0]);
            waiting.push_back(link[0] + 1);
            continue;
        }
        for (int32_t k = 0; k < link[1]; ++k) {
            Vec t[3];
            corners_of(tree, tree.order[link[0] + k], t);
            const int side = side_of(t[0], t[1], p.x, p.y);
            if (side_of(t[1], t[2], p.x, p.y) != side || side_of(t[2], t[0], p.x, p.y) != side) continue;
            const Vec normal = cross(t[1] - t[0], t[2] - t[0]);
            if (dot(normal, t[0] - p) * side > 0.0) found += side;
        }
    }
    return found;
}

}  // namespace

// Fills order (n,), boxes (2 n, 6) and links (2 n, 2); the number of nodes, or -1 where there is no memory.
PROXIMITY_API int64_t proximity_build(const double* triangles, int64_t count, int32_t* order, double* boxes, int32_t* links) {
    try {
        std::vector<Vec> middles(static_cast<size_t>(count));
        for (int64_t i = 0; i < count; ++i) {
            const double* t = triangles + 9 * i;
            middles[size_t(i)] = at(t) + at(t + 3) + at(t + 6);
            order[i] = int32_t(i);
        }
        struct Range {
            int32_t node, first, last;
        };
        std::vector<Range> waiting;
        int64_t nodes = count > 0 ? 1 : 0;
        if (count > 0) waiting.push_back({0, 0, int32_t(count)});
        while (!waiting.empty()) {
            const Range range = waiting.back();
            waiting.pop_back();
            double* box = boxes + 6 * int64_t(range.node);
            double low[3] = {INFINITE, INFINITE, INFINITE}, high[3] = {-INFINITE, -INFINITE, -INFINITE};
            for (int k = 0; k < 3; ++k) {
                box[k] = INFINITE;
                box[3 + k] = -INFINITE;
            }
            for (int32_t i = range.first; i < range.last; ++i) {
                const double* t = triangles + 9 * int64_t(order[i]);
                const Vec m = middles[size_t(order[i])];
                const double middle[3] = {m.x, m.y, m.z};
                for (int k = 0; k < 3; ++k) {
                    box[k] = std::min(box[k], std::min(t[k], std::min(t[3 + k], t[6 + k])));
                    box[3 + k] = std::max(box[3 + k], std::max(t[k], std::max(t[3 + k], t[6 + k])));
                    low[k] = std::min(low[k], middle[k]);
                    high[k] = std::max(high[k], middle[k]);
                }
            }
            int32_t* link = links + 2 * int64_t(range.node);
            if (range.last - range.first <= LEAF) {
                link[0] = range.first;
                link[1] = range.last - range.first;
                continue;
            }
            int axis = 0;
            for (int k = 1; k < 3; ++k)
                if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
            const int32_t half = range.first + (range.last - range.first) / 2;
            std::nth_element(order + range.first, order + half, order + range.last, [&](int32_t i, int32_t j) {
                const Vec &a = middles[size_t(i)], &b = middles[size_t(j)];
                const double one = axis == 0 ? a.x : axis == 1 ? a.y : a.z, other = axis == 0 ? b.x : axis == 1 ? b.y : b.z;
                return one < other || (one == other && i < j);
            });
            link[0] = int32_t(nodes);
            link[1] = 0;
            waiting.push_back({int32_t(nodes), range.first, half});
            waiting.push_back({int32_t(nodes) + 1, half, range.last});
            nodes += 2;
        }
        return nodes;
    } catch (const std::bad_alloc&) {
        return -1;
    }
}

// The least distance below `limit`: found (7,) gets it and the points on both surfaces, faces (2,) their triangles, -1
// where there is none. 0, or 1 where there is no memory.
PROXIMITY_API int32_t proximity_distance(
    const BoxTree* one, const BoxTree* other, double limit, double* found, int32_t* faces) {
    try {
        Best best = {limit * limit, {0, 0, 0}, {0, 0, 0}, -1, -1, {0, 0, 0}};
        if (one->nodes > 0 && other->nodes > 0) {
            const Vec way = at(other->boxes) + at(other->boxes + 3) - at(one->boxes) - at(one->boxes + 3);
            const double square = dot(way, way);
            if (square > 0.0 && std::isfinite(square)) best.along = (1.0 / std::sqrt(square)) * way;
            descend(*one, *other, best);
        }
        found[0] = best.one < 0 ? INFINITE : std::sqrt(best.square);
        const Vec points[2] = {best.a, best.b};
        for (int k = 0; k < 2; ++k) {
            found[1 + 3 * k] = points[k].x;
            found[2 + 3 * k] = points[k].y;
            found[3 + 3 * k] = points[k].z;
        }
        faces[0] = best.one;
        faces[1] = best.other;
        return 0;
    } catch (const std::bad_alloc&) {
        return 1;
    }
}

// Of points (n, 3) the nearest ones of a surface nearer than `limit`: distances (n,), places (n, 3), triangles (n,) or -1.
PROXIMITY_API int32_t proximity_nearest(
    const BoxTree* tree, const double* points, int64_t count, double limit, double* distances, double* places,
    int32_t* faces) {
    try {
        std::vector<std::pair<double, int32_t>> waiting;
        for (int64_t i = 0; i < count; ++i) {
            const Vec p = at(points + 3 * i);
            Best best = {limit * limit, p, p, -1, -1, {0, 0, 0}};
            waiting.clear();
            if (tree->nodes > 0) waiting.push_back({gap_to(tree->boxes, p), 0});
            while (!waiting.empty()) {
                const auto next = waiting.back();
                waiting.pop_back();
                if (!(next.first < best.square)) continue;
                const int32_t* link = tree->links + 2 * int64_t(next.second);
                if (link[1] > 0) {
                    for (int32_t k = 0; k < link[1]; ++k) {
                        const int32_t triangle = tree->order[link[0] + k];
                        Vec t[3];
                        corners_of(*tree, triangle, t);
                        if (offer(best, p, on_triangle(p, t))) best.other = triangle;
                    }
                    continue;
                }
                const double near = gap_to(tree->boxes + 6 * int64_t(link[0]), p);
                const double far = gap_to(tree->boxes + 6 * (int64_t(link[0]) + 1), p);
                const bool swapped = far < near;
                waiting.push_back({swapped ? near : far, swapped ? link[0] : link[0] + 1});
                waiting.push_back({swapped ? far : near, swapped ? link[0] + 1 : link[0]});
            }
            distances[i] = best.other < 0 ? INFINITE : std::sqrt(best.square);
            places[3 * i] = best.b.x;
            places[3 * i + 1] = best.b.y;
            places[3 * i + 2] = best.b.z;
            faces[i] = best.other;
        }
        return 0;
    } catch (const std::bad_alloc&) {
        return 1;
    }
}

// Which triangles (count, 3) over `vertices` vertices hang together: labels (vertices,) the least vertex of each one's
// piece, -1 where no triangle has it.
PROXIMITY_API void proximity_pieces(const int32_t* corners, int64_t count, int64_t vertices, int32_t* labels) {
    for (int64_t i = 0; i < vertices; ++i) labels[i] = -1;
    for (int64_t i = 0; i < 3 * count; ++i) labels[corners[i]] = corners[i];
    const auto root = [labels](int32_t vertex) {
        while (labels[vertex] != vertex) vertex = labels[vertex] = labels[labels[vertex]];
        return vertex;
    };
    for (int64_t i = 0; i < count; ++i)
        for (int k = 1; k < 3; ++k) {
            const int32_t a = root(corners[3 * i]), b = root(corners[3 * i + k]);
            labels[std::max(a, b)] = std::min(a, b);
        }
    for (int64_t i = 0; i < vertices; ++i)
        if (labels[i] >= 0) labels[i] = root(int32_t(i));
}

// How often a closed surface winds round points (n, 3): what a ray upwards leaves less what it enters.
PROXIMITY_API int32_t proximity_windings(const BoxTree* tree, const double* points, int64_t count, int32_t* windings) {
    try {
        std::vector<int32_t> waiting;
        for (int64_t i = 0; i < count; ++i) windings[i] = tree->nodes > 0 ? winding(*tree, at(points + 3 * i), waiting) : 0;
        return 0;
    } catch (const std::bad_alloc&) {
        return 1;
    }
}
