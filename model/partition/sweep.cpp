// How far a surface can go along a direction until it meets another one, compiled. The same as model/proximity/straight.py
// has it in NumPy, which says how it is decided; native.py there calls this through ctypes.

#include "boxes.h"

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

namespace {

// The first meeting so far: how far away, the triangles, where on the standing surface, and the unit normal of the plane
// in which both touch, which points to the moving one.
struct Meeting {
    double way;
    int32_t moving, standing;
    Vec point, normal;
};

// From where on the moving box is within the standing one, at the earliest; infinite where it never is.
double entry(const double* moving, const double* standing, Vec by, Vec way) {
    double begin = 0.0, end = INFINITE;
    for (int k = 0; k < 3; ++k) {
        const double low = standing[k] - moving[3 + k] - part(by, k), high = standing[3 + k] - moving[k] - part(by, k);
        const double speed = part(way, k);
        if (speed == 0.0) {
            if (low > 0.0 || high < 0.0) return INFINITE;
            continue;
        }
        const double one = low / speed, other = high / speed;
        begin = std::max(begin, std::min(one, other));
        end = std::min(end, std::max(one, other));
    }
    return begin <= end ? begin : INFINITE;
}

// Whether a point that goes along `way` comes through a triangle.
bool meets_face(Vec p, Vec way, const Vec* t) {
    const Vec u = t[1] - t[0], v = t[2] - t[0], across = cross(way, v), normal = cross(u, v);
    const double determinant = dot(u, across);
    if (!(determinant * determinant > 1e-24 * dot(normal, normal))) return false;
    const Vec offset = p - t[0], turned = cross(offset, u);
    const double a = dot(offset, across) / determinant, b = dot(way, turned) / determinant;
    return a >= 0.0 && b >= 0.0 && a + b <= 1.0 && dot(v, turned) / determinant >= 0.0;
}

// Whether a side from a that goes along `way` comes upon a side from b, and where.
bool meets_side(Vec a, Vec u, Vec way, Vec b, Vec v, Vec& where) {
    const Vec normal = cross(u, v);
    const double speed = dot(way, normal), square = dot(normal, normal);
    if (!(square > 1e-24 * dot(u, u) * dot(v, v)) || !(speed * speed > 1e-24 * square)) return false;
    const Vec gap = b - a;
    const double time = dot(gap, normal) / speed;
    if (!(time >= 0.0)) return false;
    const Vec left = gap - time * way;
    const double s = dot(cross(left, v), normal) / square, r = dot(cross(left, u), normal) / square;
    where = b + r * v;
    return s >= 0.0 && s <= 1.0 && r >= 0.0 && r <= 1.0;
}

struct Sweep {
    const BoxTree &moving, &standing;
    const double* exact;  // (n, 3, 3) the moving triangles, of which the tree has shrunk ones
    Vec by, way;

    // The planes through `from` and `to` that are square to `normal` come together.
    void offer(Meeting& best, int32_t i, int32_t j, Vec from, Vec to, Vec normal, const Vec* where = nullptr) const {
        const double speed = dot(way, normal), length = std::sqrt(dot(normal, normal));
        const double time = std::max(dot(to - from, normal) / speed, 0.0);
        if (!(time < best.way)) return;
        best = {time, i, j, where == nullptr ? from + time * way : *where, ((speed < 0.0 ? 1.0 : -1.0) / length) * normal};
    }

    void triangles(int32_t i, int32_t j, Meeting& best) const {
        Vec t[3], shrunk[3], s[3];
        corners_of(moving, i, shrunk);
        corners_of(standing, j, s);
        for (int k = 0; k < 3; ++k) {
            shrunk[k] = shrunk[k] + by;
            t[k] = at(exact + 9 * int64_t(i) + 3 * k) + by;
        }
        const Vec faces[2] = {cross(s[1] - s[0], s[2] - s[0]), cross(t[1] - t[0], t[2] - t[0])};
        for (int k = 0; k < 3; ++k) {
            if (meets_face(shrunk[k], way, s)) offer(best, i, j, t[k], s[0], faces[0]);
            if (meets_face(s[k], -1.0 * way, shrunk)) offer(best, i, j, t[0], s[k], faces[1], s + k);
            const Vec u = shrunk[(k + 1) % 3] - shrunk[k];
            for (int m = 0; m < 3; ++m) {
                const Vec v = s[(m + 1) % 3] - s[m];
                Vec where;
                if (meets_side(shrunk[k], u, way, s[m], v, where))
                    offer(best, i, j, t[k], s[m], cross(t[(k + 1) % 3] - t[k], v), &where);
            }
        }
    }

    void descend(Meeting& best) const {
        struct Pair {
            double way;
            int32_t one, other;
        };
        std::vector<Pair> waiting;
        const auto pair_of = [this](int32_t i, int32_t j) {
            return Pair{entry(moving.boxes + 6 * int64_t(i), standing.boxes + 6 * int64_t(j), by, way), i, j};
        };
        waiting.push_back(pair_of(0, 0));
        while (!waiting.empty()) {
            const Pair pair = waiting.back();
            waiting.pop_back();
            if (!(pair.way < best.way)) continue;
            const int32_t *a = moving.links + 3 * int64_t(pair.one), *b = standing.links + 3 * int64_t(pair.other);
            if (a[0] < 0 && b[0] < 0) {
                for (int32_t i = 0; i < a[2]; ++i)
                    for (int32_t j = 0; j < b[2]; ++j) triangles(moving.order[a[1] + i], standing.order[b[1] + j], best);
                continue;
            }
            const bool opens = b[0] < 0 || (a[0] >= 0 && a[2] >= b[2]);
            Pair parts[2];
            for (int k = 0; k < 2; ++k)
                parts[k] = pair_of(opens ? a[0] + k : pair.one, opens ? pair.other : b[0] + k);
            if (parts[0].way < parts[1].way) std::swap(parts[0], parts[1]);
            for (const Pair& part : parts)
                if (part.way < best.way) waiting.push_back(part);
        }
    }
};

}  // namespace

// Of a moving surface, shrunk and shifted by `by` (3,), and a standing one the way along the unit vector `along` (3,) until
// they meet, where that is below `limit`: found (7,) gets it, the point and the normal, faces (2,) the triangles or -1. 0,
// or 1 where there is no memory.
PROXIMITY_API int32_t proximity_sweep(
    const BoxTree* moving, const double* exact, const BoxTree* standing, const double* by, const double* along, double limit,
    double* found, int32_t* faces) {
    try {
        Meeting best = {limit, -1, -1, {0, 0, 0}, {0, 0, 0}};
        if (moving->nodes > 0 && standing->nodes > 0) {
            const Sweep sweep = {*moving, *standing, exact, at(by), at(along)};
            sweep.descend(best);
        }
        found[0] = best.moving < 0 ? INFINITE : best.way;
        const Vec vectors[2] = {best.point, best.normal};
        for (int k = 0; k < 6; ++k) found[1 + k] = part(vectors[k / 3], k % 3);
        faces[0] = best.moving;
        faces[1] = best.standing;
        return 0;
    } catch (const std::bad_alloc&) {
        return 1;
    }
}
