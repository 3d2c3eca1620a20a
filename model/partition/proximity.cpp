// A tree of boxes over triangles, compiled: building it, the distance of two surfaces, one of them moved if asked, the
// nearest points of a surface, and how often it winds round points. The same as model/proximity has it in NumPy; boxes.py
// there says what the arrays hold, native.py calls this through ctypes. The rules of bsp.cpp hold here, too.

#include "boxes.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <new>
#include <thread>
#include <utility>
#include <vector>

namespace {

constexpr int LEAF = 3;
constexpr int64_t PAIRS = 16;  // for which another thread is worth its start

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

// The eigenvectors of a symmetric matrix, by Jacobi's rotations (1846).
void eigenvectors(double m[3][3], Vec axes[3]) {
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 4; ++sweep) {
        const double off = std::fabs(m[0][1]) + std::fabs(m[0][2]) + std::fabs(m[1][2]);
        if (!(off > 1e-3 * (m[0][0] + m[1][1] + m[2][2]))) break;  // the box is as good with axes a little beside
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (m[p][q] == 0.0) continue;
                const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
                const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
                const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
                for (int k = 0; k < 3; ++k) {
                    const double one = m[k][p], other = m[k][q];
                    m[k][p] = c * one - s * other;
                    m[k][q] = s * one + c * other;
                }
                for (int k = 0; k < 3; ++k) {
                    const double one = m[p][k], other = m[q][k];
                    m[p][k] = c * one - s * other;
                    m[q][k] = s * one + c * other;
                    const double a = v[k][p], b = v[k][q];
                    v[k][p] = c * a - s * b;
                    v[k][q] = s * a + c * b;
                }
            }
    }
    // The third one is made of the others, so that the axes are square to each other whatever the rounding.
    axes[0] = {v[0][0], v[1][0], v[2][0]};
    axes[0] = (1.0 / std::sqrt(dot(axes[0], axes[0]))) * axes[0];
    axes[1] = {v[0][1], v[1][1], v[2][1]};
    axes[1] = axes[1] - dot(axes[0], axes[1]) * axes[0];
    axes[1] = (1.0 / std::sqrt(dot(axes[1], axes[1]))) * axes[1];
    axes[2] = cross(axes[0], axes[1]);
}

// The axes in which the corners of a node's triangles spread (Gottschalk, Lin and Manocha 1996, "OBBTree").
void spread(const BoxTree& tree, const int32_t* link, Vec centre, Vec axes[3]) {
    double sum[3] = {0, 0, 0}, square[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    for (int32_t i = 0; i < link[2]; ++i) {
        const double* from = tree.triangles + 9 * int64_t(tree.order[link[1] + i]);
        for (int k = 0; k < 9; k += 3) {
            const double x = from[k] - centre.x, y = from[k + 1] - centre.y, z = from[k + 2] - centre.z;
            sum[0] += x;
            sum[1] += y;
            sum[2] += z;
            square[0][0] += x * x;
            square[0][1] += x * y;
            square[0][2] += x * z;
            square[1][1] += y * y;
            square[1][2] += y * z;
            square[2][2] += z * z;
        }
    }
    const double count = 3.0 * link[2];
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) square[j][i] = square[i][j] = square[i][j] - sum[i] * sum[j] / count;
    eigenvectors(square, axes);
}

// Along the longest side of a triangle and square to it; false where it has no area to speak of.
bool along_sides(const Vec* t, Vec axes[3]) {
    Vec longest = t[1] - t[0];
    for (const Vec& side : {t[2] - t[1], t[0] - t[2]})
        if (dot(side, side) > dot(longest, longest)) longest = side;
    const Vec normal = cross(t[1] - t[0], t[2] - t[0]);
    const double square = dot(longest, longest), area = dot(normal, normal);
    if (!(area > 1e-20 * square * square)) return false;
    axes[0] = (1.0 / std::sqrt(square)) * longest;
    axes[2] = (1.0 / std::sqrt(area)) * normal;
    axes[1] = cross(axes[2], axes[0]);
    return true;
}

// Around a node's triangles; those of a leaf lie about as its first one does.
Oriented around(const BoxTree& tree, int32_t node) {
    const int32_t* link = tree.links + 3 * int64_t(node);
    const double* box = tree.boxes + 6 * int64_t(node);
    const Vec centre = 0.5 * (at(box) + at(box + 3));
    Oriented found;
    Vec t[3];
    corners_of(tree, tree.order[link[1]], t);
    if (link[0] >= 0 || !along_sides(t, found.axes)) spread(tree, link, centre, found.axes);
    double low[3] = {INFINITE, INFINITE, INFINITE}, high[3] = {-INFINITE, -INFINITE, -INFINITE};
    for (int32_t i = 0; i < link[2]; ++i) {
        const double* from = tree.triangles + 9 * int64_t(tree.order[link[1] + i]);
        for (int k = 0; k < 9; k += 3) {
            const Vec p = at(from + k) - centre;
            for (int axis = 0; axis < 3; ++axis) {
                const double place = dot(p, found.axes[axis]);
                low[axis] = std::min(low[axis], place);
                high[axis] = std::max(high[axis], place);
            }
        }
    }
    found.middle = centre;
    for (int axis = 0; axis < 3; ++axis) {
        found.middle = found.middle + (0.5 * (low[axis] + high[axis])) * found.axes[axis];
        found.half[axis] = 0.5 * (high[axis] - low[axis]);
    }
    return found;
}

enum : uint8_t { UNKNOWN, WRITING, KNOWN };

// Made when it is first asked for. Of several threads that ask at once one writes it down, the others have their `own`.
const Oriented& oriented_box(const BoxTree& tree, int32_t node, Oriented& own) {
    auto* state = reinterpret_cast<std::atomic<uint8_t>*>(tree.states + node);
    Oriented& kept = tree.oriented[node];
    if (state->load(std::memory_order_acquire) == KNOWN) return kept;
    own = around(tree, node);
    uint8_t before = UNKNOWN;
    if (state->compare_exchange_strong(before, WRITING, std::memory_order_acquire)) {
        kept = own;
        state->store(KNOWN, std::memory_order_release);
    }
    return own;
}

// Takes points of the other surface into the space of the first.
struct Pose {
    Vec rows[3];
    Vec by;
    bool moves;

    Vec turned(Vec v) const { return moves ? Vec{dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)} : v; }
    Vec placed(Vec p) const { return moves ? turned(p) + by : p; }
};

inline Pose pose_of(const double* matrix) {
    if (matrix == nullptr) return {{}, {0, 0, 0}, false};
    return {{at(matrix), at(matrix + 4), at(matrix + 8)}, {matrix[3], matrix[7], matrix[11]}, true};
}

// Two trees, the second one moved.
struct Couple {
    const BoxTree &one, &other;
    Pose pose;
    double floor;  // the rounding of boxes' gaps
};

struct Pair {
    double square, between;  // of the boxes' gap at the least, and of the way from middle to middle
    int32_t one, other;
    bool opens;  // the first one's is the larger box
};

// The square of what two boxes are apart at the least, as far as it counts up to `most`: along the axes of the one, or of
// the other.
double apart(const Oriented& one, const Oriented& other, double floor, double most) {
    const Vec way = other.middle - one.middle;
    double turn[3][3], first = 0.0, second = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) turn[i][j] = std::fabs(dot(one.axes[i], other.axes[j]));
        const double gap = std::fabs(dot(way, one.axes[i])) - one.half[i] - floor -
            (turn[i][0] * other.half[0] + turn[i][1] * other.half[1] + turn[i][2] * other.half[2]);
        if (gap > 0.0) first += gap * gap;
    }
    if (first >= most) return first;
    for (int i = 0; i < 3; ++i) {
        const double gap = std::fabs(dot(way, other.axes[i])) - other.half[i] - floor -
            (turn[0][i] * one.half[0] + turn[1][i] * one.half[1] + turn[2][i] * one.half[2]);
        if (gap > 0.0) second += gap * gap;
    }
    return std::max(first, second);
}

inline double length_of(const Oriented& box) { return std::max(std::max(box.half[0], box.half[1]), box.half[2]); }

Pair pair_of(const Couple& of, int32_t i, int32_t j, double most) {
    if (!of.pose.moves) {
        const double *box = of.one.boxes + 6 * int64_t(i), *counter = of.other.boxes + 6 * int64_t(j);
        double square = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double gap = std::max(box[k] - counter[3 + k], counter[k] - box[3 + k]);
            if (gap > 0.0) square += gap * gap;
        }
        if (!(square < most)) return {square, 0.0, i, j, false};
    }
    Oriented spare, spares;
    const Oriented &one = oriented_box(of.one, i, spare), &stored = oriented_box(of.other, j, spares);
    if (of.pose.moves) {
        spares = {of.pose.placed(stored.middle),
            {of.pose.turned(stored.axes[0]), of.pose.turned(stored.axes[1]), of.pose.turned(stored.axes[2])},
            {stored.half[0], stored.half[1], stored.half[2]}};
    }
    const Oriented& other = of.pose.moves ? spares : stored;
    const Vec way = other.middle - one.middle;
    return {apart(one, other, of.floor, most), dot(way, way), i, j, length_of(one) >= length_of(other)};
}

// Whether the plane of a triangle keeps another one as far from it as the best way is long.
inline bool beyond(const Vec* plane, const Vec* t, double square) {
    const Vec normal = cross(plane[1] - plane[0], plane[2] - plane[0]);
    const double a = dot(t[0] - plane[0], normal), b = dot(t[1] - plane[0], normal), c = dot(t[2] - plane[0], normal);
    const double least = std::min(std::min(a, b), c), most = std::max(std::max(a, b), c);
    const double height = least > 0.0 ? least : most < 0.0 ? -most : 0.0;
    return height * height > square * dot(normal, normal);
}

void try_triangles(int32_t left, int32_t right, const Vec* t, const Vec* s, Best& best) {
    if (!nearest_of(t, s, best)) return;
    best.one = left;
    best.other = right;
    if (best.square > 0.0) best.along = (1.0 / std::sqrt(best.square)) * (best.b - best.a);
}

inline void corners_of(const Couple& of, int32_t triangle, Vec* t) {
    corners_of(of.other, triangle, t);
    for (int k = 0; k < 3; ++k) t[k] = of.pose.placed(t[k]);
}

// The triangles of two leaves, but for those that a slab across the best way, or the plane of one, keeps apart: most.
void leaves(const Couple& of, int32_t i, int32_t j, Best& best) {
    const int32_t *a = of.one.links + 3 * int64_t(i), *b = of.other.links + 3 * int64_t(j);
    for (int32_t n = 0; n < b[2]; ++n) {
        const int32_t right = of.other.order[b[1] + n];
        Vec s[3];
        corners_of(of, right, s);
        for (int32_t m = 0; m < a[2]; ++m) {
            const int32_t left = of.one.order[a[1] + m];
            Vec t[3];
            corners_of(of.one, left, t);
            const Vec way = best.along;
            const double ends = std::max(std::max(dot(way, t[0]), dot(way, t[1])), dot(way, t[2]));
            const double begins = std::min(std::min(dot(way, s[0]), dot(way, s[1])), dot(way, s[2]));
            const double apart = begins - ends;
            if (apart > 0.0 && apart * apart >= best.square) continue;
            if (beyond(t, s, best.square) || beyond(s, t, best.square)) continue;
            try_triangles(left, right, t, s, best);
            if (best.square == 0.0) return;
        }
    }
}

// From the pair of roots down, the nearer boxes first; pairs that are farther apart than what was found are left out.
void descend(const Couple& of, Best& best) {
    std::vector<Pair> waiting;
    waiting.push_back(pair_of(of, 0, 0, best.square));
    while (!waiting.empty() && best.square > 0.0) {
        const Pair pair = waiting.back();
        waiting.pop_back();
        if (!(pair.square < best.square)) continue;
        const int32_t left = of.one.links[3 * int64_t(pair.one)], right = of.other.links[3 * int64_t(pair.other)];
        if (left < 0 && right < 0) {
            leaves(of, pair.one, pair.other, best);
            continue;
        }
        const bool opens = right < 0 || (left >= 0 && pair.opens);
        Pair parts[2];
        for (int k = 0; k < 2; ++k)
            parts[k] = pair_of(of, opens ? left + k : pair.one, opens ? pair.other : right + k, best.square);
        const bool same = parts[0].square == parts[1].square;
        if (same ? parts[0].between < parts[1].between : parts[0].square < parts[1].square) std::swap(parts[0], parts[1]);
        for (const Pair& part : parts)
            if (part.square < best.square) waiting.push_back(part);
    }
}

// The least distance below `limit`, beginning with what triangles `faces` tell, where these are any.
void least(const Couple& of, double limit, double* found, int32_t* faces) {
    Best best = {limit * limit, {0, 0, 0}, {0, 0, 0}, -1, -1, {0, 0, 0}};
    if (of.one.nodes > 0 && of.other.nodes > 0) {
        const double *box = of.one.boxes, *counter = of.other.boxes;
        const Vec middle = 0.5 * (at(counter) + at(counter + 3));
        const Vec way = of.pose.placed(middle) - 0.5 * (at(box) + at(box + 3));
        const double square = dot(way, way);
        if (square > 0.0 && std::isfinite(square)) best.along = (1.0 / std::sqrt(square)) * way;
        if (faces[0] >= 0) {
            Vec t[3], s[3];
            corners_of(of.one, faces[0], t);
            corners_of(of, faces[1], s);
            try_triangles(faces[0], faces[1], t, s, best);
        }
        descend(of, best);
    }
    found[0] = best.one < 0 ? INFINITE : std::sqrt(best.square);
    const Vec points[2] = {best.a, best.b};
    for (int k = 0; k < 6; ++k) found[1 + k] = part(points[k / 3], k % 3);
    faces[0] = best.one;
    faces[1] = best.other;
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

// What a ray upwards from p adds where it goes through a triangle.
inline int through(const Vec* t, Vec p) {
    const int side = side_of(t[0], t[1], p.x, p.y);
    if (side_of(t[1], t[2], p.x, p.y) != side || side_of(t[2], t[0], p.x, p.y) != side) return 0;
    return dot(cross(t[1] - t[0], t[2] - t[0]), t[0] - p) * side > 0.0 ? side : 0;
}

int32_t winding(const BoxTree& tree, Vec p, std::vector<int32_t>& waiting) {
    int32_t found = 0;
    waiting.assign(1, 0);
    while (!waiting.empty()) {
        const int64_t node = waiting.back();
        waiting.pop_back();
        const double* box = tree.boxes + 6 * node;
        if (p.x < box[0] || p.x > box[3] || p.y < box[1] || p.y > box[4] || p.z > box[5]) continue;
        const int32_t* link = tree.links + 3 * node;
        if (link[0] >= 0) {
            waiting.push_back(link[0]);
            waiting.push_back(link[0] + 1);
            continue;
        }
        for (int32_t k = 0; k < link[2]; ++k) {
            Vec t[3];
            corners_of(tree, tree.order[link[1] + k], t);
            found += through(t, p);
        }
    }
    return found;
}

// The boxes of triangles in `order` (count,), which gets another order: boxes (2 count, 6), links (2 count, 3); the
// number of nodes.
int64_t build(const double* triangles, int64_t count, int32_t* order, double* boxes, int32_t* links) {
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
        int32_t* link = links + 3 * int64_t(range.node);
        link[0] = -1;
        link[1] = range.first;
        link[2] = range.last - range.first;
        if (link[2] <= LEAF) continue;
        int axis = 0;
        for (int k = 1; k < 3; ++k)
            if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
        const int32_t half = range.first + link[2] / 2;
        std::nth_element(order + range.first, order + half, order + range.last, [&](int32_t i, int32_t j) {
            const double one = part(middles[size_t(i)], axis), other = part(middles[size_t(j)], axis);
            return one < other || (one == other && i < j);
        });
        link[0] = int32_t(nodes);
        waiting.push_back({int32_t(nodes), range.first, half});
        waiting.push_back({int32_t(nodes) + 1, half, range.last});
        nodes += 2;
    }
    return nodes;
}

// A surface as it crosses the border: `vertices` (n, 3), `corners` (m, 3), as native.py declares it.
struct Surface {
    const double* vertices;
    const int32_t* corners;
    int64_t count, faces;
};

// A tree of some triangles of a surface, `which` of them, that lasts as long as a question.
struct Cutout {
    std::vector<int32_t> which, order, links;
    std::vector<double> triangles, boxes;
    std::vector<Oriented> oriented;
    std::vector<uint8_t> states, codes;
    BoxTree tree;

    // Those whose boxes reach into a box, which is drawn in to what they hold of it; false for none.
    bool take(const Surface& surface, double* box) {
        codes.resize(static_cast<size_t>(surface.count));
        for (int64_t i = 0; i < surface.count; ++i) {
            const double* p = surface.vertices + 3 * i;
            codes[size_t(i)] = uint8_t((p[0] < box[0]) | (p[1] < box[1]) << 1 | (p[2] < box[2]) << 2 |
                (p[0] > box[3]) << 3 | (p[1] > box[4]) << 4 | (p[2] > box[5]) << 5);
        }
        which.clear();
        double held[6] = {INFINITE, INFINITE, INFINITE, -INFINITE, -INFINITE, -INFINITE};
        for (int64_t i = 0; i < surface.faces; ++i) {
            const int32_t* c = surface.corners + 3 * i;
            if (codes[size_t(c[0])] & codes[size_t(c[1])] & codes[size_t(c[2])]) continue;
            which.push_back(int32_t(i));
            for (int k = 0; k < 3; ++k)
                for (int axis = 0; axis < 3; ++axis) {
                    const double place = surface.vertices[3 * int64_t(c[k]) + axis];
                    held[axis] = std::min(held[axis], place);
                    held[3 + axis] = std::max(held[3 + axis], place);
                }
        }
        for (int axis = 0; axis < 3; ++axis) {
            box[axis] = std::max(box[axis], held[axis]);
            box[3 + axis] = std::min(box[3 + axis], held[3 + axis]);
        }
        return !which.empty();
    }

    void grow(const Surface& surface) {
        const size_t count = which.size();
        triangles.resize(9 * count);
        for (size_t i = 0; i < count; ++i)
            for (size_t k = 0; k < 9; ++k) {
                const int32_t vertex = surface.corners[3 * int64_t(which[i]) + int64_t(k / 3)];
                triangles[9 * i + k] = surface.vertices[3 * int64_t(vertex) + int64_t(k % 3)];
            }
        order.resize(count);
        boxes.resize(12 * count);
        links.resize(6 * count);
        const int64_t nodes = build(triangles.data(), int64_t(count), order.data(), boxes.data(), links.data());
        oriented.resize(size_t(nodes));
        states.assign(size_t(nodes), UNKNOWN);
        tree = {triangles.data(), order.data(), boxes.data(), links.data(), oriented.data(), states.data(), nodes};
    }
};

// The rounding of gaps between boxes of two trees.
double floor_of(const BoxTree& one, const BoxTree& other, const Pose& pose) {
    double most = 0.0;
    for (const BoxTree* tree : {&one, &other})
        if (tree->nodes > 0)
            for (int k = 0; k < 6; ++k) most = std::max(most, std::fabs(tree->boxes[k]));
    if (pose.moves) most = std::max(most, std::max(std::fabs(pose.by.x), std::max(std::fabs(pose.by.y), std::fabs(pose.by.z))));
    return 32.0 * std::numeric_limits<double>::epsilon() * most;
}

// The least distance of two surfaces below `limit`; `boxes` are theirs.
void near(
    const Surface& one, const Surface& other, const double* const boxes[2], double limit, Cutout& left, Cutout& right,
    double* found, int32_t* faces) {
    found[0] = INFINITE;
    for (int k = 1; k < 7; ++k) found[k] = 0.0;
    faces[0] = faces[1] = -1;
    const double reach = limit * (1.0 + 1e-9);
    double common[6];
    for (int k = 0; k < 3; ++k) {
        common[k] = std::max(boxes[1][k] - reach, boxes[0][k]);
        common[3 + k] = std::min(boxes[1][3 + k] + reach, boxes[0][3 + k]);
    }
    if (!left.take(one, common)) return;
    for (int k = 0; k < 3; ++k) {
        common[k] -= reach;
        common[3 + k] += reach;
    }
    if (!right.take(other, common)) return;
    left.grow(one);
    right.grow(other);
    const Pose still = pose_of(nullptr);
    least({left.tree, right.tree, still, floor_of(left.tree, right.tree, still)}, limit, found, faces);
    if (faces[0] < 0) return;
    faces[0] = left.which[size_t(faces[0])];
    faces[1] = right.which[size_t(faces[1])];
}

}  // namespace

// Fills order (n,), boxes (2 n, 6) and links (2 n, 3); the number of nodes, or -1 where there is no memory.
PROXIMITY_API int64_t proximity_build(const double* triangles, int64_t count, int32_t* order, double* boxes, int32_t* links) {
    try {
        return build(triangles, count, order, boxes, links);
    } catch (const std::bad_alloc&) {
        return -1;
    }
}

// The least distance below `limit`: found (7,) gets it and the points on both surfaces, faces (2,) their triangles, -1
// where there is none. Where `faces` holds triangles, these are looked at first. `pose`, (4, 4) or none, moves the second
// surface. 0, or 1 where there is no memory.
PROXIMITY_API int32_t proximity_distance(
    const BoxTree* one, const BoxTree* other, const double* pose, double limit, double* found, int32_t* faces) {
    try {
        const Pose moved = pose_of(pose);
        least({*one, *other, moved, floor_of(*one, *other, moved)}, limit, found, faces);
        return 0;
    } catch (const std::bad_alloc&) {
        return 1;
    }
}

// The same of pairs (count, 2) of surfaces without trees, each below a finite limit of its own: of what one has near the
// box of the other. `boxes` (surfaces, 2, 3) are theirs; found (count, 7), faces (count, 2). All processors work on it.
PROXIMITY_API int32_t proximity_near(
    const Surface* const* surfaces, const double* boxes, const int32_t* pairs, const double* limits, int64_t count,
    double* found, int32_t* faces) {
    std::atomic<int64_t> next(0);
    std::atomic<bool> full(false);
    const auto work = [&]() {
        try {
            Cutout left, right;
            for (int64_t k = next++; k < count && !full; k = next++) {
                const int32_t one = pairs[2 * k], other = pairs[2 * k + 1];
                const double* given[2] = {boxes + 6 * int64_t(one), boxes + 6 * int64_t(other)};
                near(*surfaces[one], *surfaces[other], given, limits[k], left, right, found + 7 * k, faces + 2 * k);
            }
        } catch (const std::bad_alloc&) {
            full = true;
        }
    };
    std::vector<std::thread> others;
    const int64_t most = std::min<int64_t>(std::thread::hardware_concurrency(), count / PAIRS);
    try {
        for (int64_t k = 1; k < most; ++k) others.emplace_back(work);
    } catch (const std::exception&) {  // no thread is to be had: this one does the rest
    }
    work();
    for (std::thread& other : others) other.join();
    return full ? 1 : 0;
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
                const int32_t* link = tree->links + 3 * int64_t(next.second);
                if (link[0] < 0) {
                    for (int32_t k = 0; k < link[2]; ++k) {
                        const int32_t triangle = tree->order[link[1] + k];
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

// The same of a surface without a tree, for a few points.
PROXIMITY_API void proximity_windings_of(const Surface* surface, const double* points, int64_t count, int32_t* windings) {
    for (int64_t i = 0; i < count; ++i) {
        const Vec p = at(points + 3 * i);
        int32_t found = 0;
        for (int64_t face = 0; face < surface->faces; ++face) {
            const int32_t* c = surface->corners + 3 * face;
            const Vec t[3] = {at(surface->vertices + 3 * int64_t(c[0])), at(surface->vertices + 3 * int64_t(c[1])),
                at(surface->vertices + 3 * int64_t(c[2]))};
            found += through(t, p);
        }
        windings[i] = found;
    }
}
