// The BSP tree, compiled: building it, putting further faces into it, and the painter's order. The same as build.py and
// order.py in NumPy; faces.py and tree.py say what the arrays hold, native.py calls this through ctypes.
//
// Plain C at the border, no dependency, no state, no exception leaves. What comes in has been checked by native.py.
// It is built as C++17, and keeps to C++14 because MSVC, which does not know that flag, takes it for that. No fused
// multiplications (-ffp-contract=off): neighbours must get the same points from the same cut.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

#if defined(_WIN32)
#define BSP_API extern "C" __declspec(dllexport)
#else
#define BSP_API extern "C" __attribute__((visibility("default")))
#endif

namespace {

// ---------------------------------------------------------------------------------------------------------------------
// What crosses the border; native.py declares the same.

struct FacesView {
    const double* points;  // (points_count, 3)
    const int32_t* corners;
    const int32_t* starts;  // (count + 1,)
    const double* planes;   // (planes_count, 4)
    const int32_t* plane_of;
    const int32_t* group;
    const int8_t* side;
    int64_t points_count;
    int64_t count;
};

struct TreeView {
    const double* points;
    const int32_t* corners;
    const int32_t* starts;  // (fragments + 1,)
    const int32_t* source;
    const double* plane;  // (nodes, 4)
    const int32_t* front;
    const int32_t* back;
    const int32_t* first;
    const int32_t* count;
    const int8_t* kind;
    int64_t points_count;
    int64_t fragments;
    int64_t nodes;
    int64_t root;
};

// A tree as its order needs it: what belongs to a node side by side, and the planes of the pieces to be put in order.
struct OrderNode {  // as long as a line of most caches
    double plane[4];
    int32_t front, back, first, count, kind, unused[3];
};

struct OrderView {
    const OrderNode* nodes;
    const int32_t* starts;  // of fragments, where pieces are their triangles; null where they are fragments
    const double* planes;
    const int32_t* plane_of;  // of pieces
    int64_t planes_count;
    int64_t count;  // of nodes
    int64_t root;
};

// done, total: fragments that have found their place, and all there are so far. Anything but 0 stops the work.
using Progress = int32_t (*)(int64_t, int64_t);

enum Status : int32_t { DONE = 0, NO_MEMORY = 1, TOO_MANY = 2, STOPPED = 3, NO_TREE = 4 };
enum Kind : int8_t { INNER = 0, CONVEX = 1, CONCAVE = 2 };

struct Failure {
    Status status;
};

// ---------------------------------------------------------------------------------------------------------------------
// Choosing planes. Measured on CSG solids of 1,000 to 1,000,000 triangles; the numbers are flat around these.

constexpr int SAMPLE = 64;         // polygons that stand for all of a node's
constexpr int FACE_PLANES = 8;     // candidates among the planes of the sample's own faces
constexpr double SPLIT_COST = 8;   // of a split in the sample, against n log n for what is left to do on each side
constexpr size_t MUTUAL = 64;      // up to here all pairs are compared to see whether a node is a convex leaf
constexpr double LOPSIDED = 0.85;  // an axis plane that leaves more than this part of the sample on one side is no use
constexpr double SLIM = 1e-4;      // epsilons: a face narrower than this tells nothing about the plane it lies in
constexpr size_t REPORT = 4096;    // fragments looked at between two reports of progress

enum Where { WITHIN, BEHIND, BEFORE, ACROSS };

// A convex polygon on its way down: corners in a pool of indices, and the face it is a piece of.
struct Piece {
    int32_t begin, size, source;
};

struct Candidate {
    double plane[4];
    int32_t number;  // of the face plane; -1: along an axis
};

inline double height(const double* plane, const double* p) {
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] - plane[3];
}

template <class T>
int32_t index(T number) {
    if (static_cast<uint64_t>(number) > static_cast<uint64_t>(std::numeric_limits<int32_t>::max()))
        throw Failure{TOO_MANY};
    return static_cast<int32_t>(number);
}

// The work n log2(n + 1) that n polygons of the sample leave on one side.
struct Work {
    double of[2 * SAMPLE + 1];
    Work() {
        for (int n = 0; n <= 2 * SAMPLE; ++n) of[n] = n * std::log2(n + 1.0);
    }
};
const Work WORK;

// Numbers as good as random and the same every time (xorshift32, Marsaglia 2003).
struct Dice {
    uint32_t state = 2463534242u;
    uint32_t throw_below(uint32_t sides) {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        return static_cast<uint32_t>((static_cast<uint64_t>(state) * sides) >> 32);
    }
};

// ---------------------------------------------------------------------------------------------------------------------

class Builder {
   public:
    // What is made. Points and fragments come after those that the caller has; nodes are all there are.
    std::vector<double> points;
    std::vector<int32_t> corners, ends, source;
    std::vector<double> plane;
    std::vector<int32_t> front, back, first, count;
    std::vector<int8_t> kind;
    int32_t root = -1;

    Builder(const FacesView& faces, double epsilon, Progress progress)
        : faces_(faces), epsilon_(epsilon), progress_(progress), known_(faces.points), known_count_(faces.points_count),
          slim_(static_cast<size_t>(faces.count), UNKNOWN) {}

    void build() {
        pool_.assign(faces_.corners, faces_.corners + faces_.starts[faces_.count]);
        corners.reserve(pool_.size() + pool_.size() / 4);
        for (auto* of_fragments : {&ends, &source})
            of_fragments->reserve(static_cast<size_t>(faces_.count) + static_cast<size_t>(faces_.count) / 4);
        arena_.reserve(static_cast<size_t>(faces_.count));
        for (int32_t face = 0; face < faces_.count; ++face) arena_.push_back(piece_of(face));
        if (!arena_.empty()) grow(-1, false);
    }

    // The faces from `first_new` on, whose points are those from `first_point` on, are put into the tree of the others.
    // Fragments and nodes of the tree keep their numbers; what changes in a node is made anew after them: an inner node
    // with arrivals in its plane owns copies, a leaf gives way to the tree of its fragments and the arrivals.
    void insert(const TreeView& tree, int32_t first_new, int64_t first_point) {
        adopt(tree);
        points.assign(faces_.points + 3 * first_point, faces_.points + 3 * faces_.points_count);
        const int32_t moved = index(tree.points_count) - index(first_point);
        pool_.assign(faces_.corners + faces_.starts[first_new], faces_.corners + faces_.starts[faces_.count]);
        for (int32_t& corner : pool_) corner += moved;
        std::vector<Piece> arrivals;
        for (int32_t face = first_new; face < faces_.count; ++face) {
            Piece piece = piece_of(face);
            piece.begin -= faces_.starts[first_new];
            arrivals.push_back(piece);
        }
        struct Arrival {
            int32_t node, parent;
            bool before;
            size_t count;
        };
        std::vector<Arrival> waiting;
        if (!arrivals.empty()) waiting.push_back({root, -1, false, arrivals.size()});
        int64_t visits = 0;
        while (!waiting.empty()) {
            const Arrival at = waiting.back();
            waiting.pop_back();
            if (++visits > 2 * tree.nodes + 2) throw Failure{NO_TREE};
            const size_t begin = arrivals.size() - at.count;
            if (at.node < 0 || kind[at.node] != INNER) {
                arena_.clear();
                if (at.node >= 0) take_fragments(tree, at.node);
                arena_.insert(arena_.end(), arrivals.begin() + static_cast<ptrdiff_t>(begin), arrivals.end());
                arrivals.resize(begin);
                grow(at.parent, at.before);
                continue;
            }
            const double* own = plane.data() + 4 * static_cast<size_t>(at.node);
            const Candidate cut{{own[0], own[1], own[2], own[3]}, -1};
            partition(arrivals.data() + begin, at.count, cut);
            arrivals.resize(begin);
            if (!within_.empty()) {
                const int32_t owned = fragments();
                if (first[at.node] + int64_t{count[at.node]} > tree.fragments) throw Failure{NO_TREE};
                for (int32_t i = first[at.node], last = i + count[at.node]; i < last; ++i)
                    emit(tree.corners + tree.starts[i], tree.corners + tree.starts[i + 1], tree.source[i]);
                for (const Piece& piece : within_) emit(piece);
                first[at.node] = owned;
                count[at.node] = fragments() - owned;
            }
            for (bool before : {false, true}) {
                const std::vector<Piece>& side = before ? before_ : behind_;
                if (side.empty()) continue;
                arrivals.insert(arrivals.end(), side.begin(), side.end());
                waiting.push_back({before ? front[at.node] : back[at.node], at.node, before, side.size()});
            }
        }
    }

   private:
    const FacesView& faces_;
    const double epsilon_;
    const Progress progress_;
    const double* known_;  // points that the caller has; `points` come after them
    int64_t known_count_;
    int64_t known_corners_ = 0, known_fragments_ = 0;
    std::vector<int32_t> pool_;  // rings of pieces
    std::vector<Piece> arena_;   // pieces of all nodes that wait, the next one's last
    std::vector<Piece> within_, behind_, before_;
    std::vector<double> heights_;
    std::vector<int32_t> back_ring_, front_ring_;
    enum Slim : int8_t { UNKNOWN, NO, YES };
    std::vector<Slim> slim_;  // of faces
    size_t looked_at_ = 0;
    Dice dice_;

    Piece piece_of(int32_t face) const {
        return {faces_.starts[face], faces_.starts[face + 1] - faces_.starts[face], face};
    }

    const double* point(int32_t i) const {
        return i < known_count_ ? known_ + 3 * static_cast<int64_t>(i) : points.data() + 3 * (i - known_count_);
    }

    int32_t plane_of(const Piece& piece) const { return faces_.plane_of[piece.source]; }

    const double* plane_at(const Piece& piece) const {
        return faces_.planes + 4 * static_cast<size_t>(plane_of(piece));
    }

    int32_t fragments() const { return index(static_cast<size_t>(known_fragments_) + source.size()); }

    // --- insertion ---

    void adopt(const TreeView& tree) {
        const size_t nodes = static_cast<size_t>(tree.nodes);
        plane.assign(tree.plane, tree.plane + 4 * nodes);
        front.assign(tree.front, tree.front + nodes);
        back.assign(tree.back, tree.back + nodes);
        first.assign(tree.first, tree.first + nodes);
        count.assign(tree.count, tree.count + nodes);
        kind.assign(tree.kind, tree.kind + nodes);
        root = static_cast<int32_t>(tree.root);
        known_ = tree.points;
        known_count_ = tree.points_count;
        known_corners_ = tree.starts[tree.fragments];
        known_fragments_ = tree.fragments;
    }

    void take_fragments(const TreeView& tree, int32_t node) {
        if (first[node] + int64_t{count[node]} > tree.fragments) throw Failure{NO_TREE};
        for (int32_t i = first[node], last = i + count[node]; i < last; ++i) {
            const int32_t* begin = tree.corners + tree.starts[i];
            const int32_t* end = tree.corners + tree.starts[i + 1];
            arena_.push_back({index(pool_.size()), static_cast<int32_t>(end - begin), tree.source[i]});
            pool_.insert(pool_.end(), begin, end);
        }
    }

    // --- nodes and fragments ---

    int32_t new_node(Kind of, const double* with, int32_t parent, bool before) {
        const int32_t node = index(kind.size());
        kind.push_back(of);
        for (int i = 0; i < 4; ++i) plane.push_back(with ? with[i] : 0.0);
        front.push_back(-1);
        back.push_back(-1);
        first.push_back(fragments());
        count.push_back(0);
        if (parent < 0)
            root = node;
        else
            (before ? front : back)[parent] = node;
        return node;
    }

    void emit(const int32_t* begin, const int32_t* end, int32_t face) {
        corners.insert(corners.end(), begin, end);
        ends.push_back(index(static_cast<size_t>(known_corners_) + corners.size()));
        source.push_back(face);
    }

    void emit(const Piece& piece) {
        emit(pool_.data() + piece.begin, pool_.data() + piece.begin + piece.size, piece.source);
    }

    // --- the tree of the pieces in the arena ---

    // Lists stay in the order of their sources, because each side keeps the order of what it gets.
    void grow(int32_t above, bool before_it) {
        struct Waiting {
            size_t count;
            int32_t parent;
            bool before;
        };
        std::vector<Waiting> waiting{{arena_.size(), above, before_it}};
        while (!waiting.empty()) {
            const Waiting now = waiting.back();
            waiting.pop_back();
            const size_t begin = arena_.size() - now.count;
            report(now.count);
            Kind leaf;
            if (is_leaf(arena_.data() + begin, now.count, leaf)) {
                const int32_t node = new_node(leaf, nullptr, now.parent, now.before);
                for (size_t i = begin; i < arena_.size(); ++i) emit(arena_[i]);
                count[node] = index(now.count);
                arena_.resize(begin);
                continue;
            }
            Candidate best = chosen(arena_.data() + begin, now.count, true);
            partition(arena_.data() + begin, now.count, best);
            if (best.number < 0 && std::max(behind_.size(), before_.size()) >= now.count) {
                // What the sample promised is not so. A face's own plane always takes at least that face away.
                best = chosen(arena_.data() + begin, now.count, false);
                partition(arena_.data() + begin, now.count, best);
            }
            arena_.resize(begin);
            const int32_t node = new_node(INNER, best.plane, now.parent, now.before);
            for (const Piece& piece : within_) emit(piece);
            count[node] = index(within_.size());
            for (bool before : {false, true}) {
                const std::vector<Piece>& side = before ? before_ : behind_;
                if (side.empty()) continue;
                arena_.insert(arena_.end(), side.begin(), side.end());
                waiting.push_back({side.size(), node, before});
            }
        }
    }

    void report(size_t pieces) {
        looked_at_ += pieces;
        if (!progress_ || looked_at_ < REPORT) return;
        looked_at_ = 0;
        const int64_t done = static_cast<int64_t>(source.size());
        if (progress_(done, done + static_cast<int64_t>(arena_.size()))) throw Failure{STOPPED};
    }

    // --- leaves ---

    bool is_leaf(const Piece* pieces, size_t n, Kind& leaf) {
        leaf = CONVEX;
        if (n == 1) return true;
        const int32_t group = faces_.group[pieces[0].source];
        size_t same = 0;
        if (group >= 0)
            while (same < n && faces_.group[pieces[same].source] == group) ++same;
        if (same == n) {
            leaf = faces_.side[pieces[0].source] < 0 ? CONCAVE : CONVEX;
            return true;
        }
        size_t wide = 0;
        while (wide < n && is_slim(pieces[wide].source)) ++wide;
        return wide == n || (n <= MUTUAL && are_mutual(pieces, n, leaf));
    }

    // Whether each piece lies behind the planes of all others, or before them all. Two that face each other in one
    // plane are neither: there the order of the sources counts, which only an inner node keeps.
    bool are_mutual(const Piece* pieces, size_t n, Kind& leaf) {
        bool behind = true, before = true;
        for (size_t j = 0; j < n; ++j) {
            if (is_slim(pieces[j].source)) continue;
            const double* own = plane_at(pieces[j]);
            for (size_t i = 0; i < n; ++i) {
                if (plane_of(pieces[i]) == plane_of(pieces[j])) continue;
                double low = 0.0, high = 0.0;
                reach(pieces[i], own, low, high);
                if (high > epsilon_) behind = false;
                if (low < -epsilon_) before = false;
                if (!behind && !before) return false;
                if (high > epsilon_ || low < -epsilon_) continue;
                const double* other = plane_at(pieces[i]);
                if (own[0] * other[0] + own[1] * other[1] + own[2] * other[2] < 0.0) return false;
            }
        }
        leaf = behind ? CONVEX : CONCAVE;
        return true;
    }

    void reach(const Piece& piece, const double* of, double& low, double& high) const {
        const int32_t* ring = pool_.data() + piece.begin;
        low = high = height(of, point(ring[0]));
        for (int32_t i = 1; i < piece.size; ++i) {
            const double h = height(of, point(ring[i]));
            low = std::min(low, h);
            high = std::max(high, h);
        }
    }

    // --- planes ---

    bool is_slim(int32_t face) {
        Slim& known = slim_[static_cast<size_t>(face)];
        if (known == UNKNOWN) {
            const int32_t* ring = faces_.corners + faces_.starts[face];
            const int32_t size = faces_.starts[face + 1] - faces_.starts[face];
            const double* origin = faces_.points + 3 * static_cast<size_t>(ring[0]);
            double area[3] = {0.0, 0.0, 0.0}, around = 0.0;
            for (int32_t i = 0; i < size; ++i) {
                const double* p = faces_.points + 3 * static_cast<size_t>(ring[i]);
                const double* q = faces_.points + 3 * static_cast<size_t>(ring[i + 1 == size ? 0 : i + 1]);
                const double a[3] = {p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
                const double b[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
                area[0] += a[1] * b[2] - a[2] * b[1];
                area[1] += a[2] * b[0] - a[0] * b[2];
                area[2] += a[0] * b[1] - a[1] * b[0];
                around += std::sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
            }
            const double size_of_area = std::sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
            known = size_of_area > SLIM * epsilon_ * around ? NO : YES;
        }
        return known == YES;
    }

    Candidate plane_through(const Piece& piece) const {
        const double* own = plane_at(piece);
        return {{own[0], own[1], own[2], own[3]}, plane_of(piece)};
    }

    Where where(const Piece& piece, const Candidate& cut) const {
        if (plane_of(piece) == cut.number) return WITHIN;
        double low, high;
        reach(piece, cut.plane, low, high);
        if (low >= -epsilon_) return high <= epsilon_ ? WITHIN : BEFORE;
        return high <= epsilon_ ? BEHIND : ACROSS;
    }

    // The best of some planes, as a sample of the pieces sees them: cuts cost, and so does the work left on both sides,
    // except on a side that is one convex body.
    Candidate chosen(const Piece* pieces, size_t n, bool with_axes) {
        Piece sample[SAMPLE];
        const uint32_t size = static_cast<uint32_t>(std::min<size_t>(n, SAMPLE));
        for (uint32_t i = 0; i < size; ++i) {
            const size_t low = i * n / size, high = (i + size_t{1}) * n / size;
            sample[i] = pieces[low + dice_.throw_below(static_cast<uint32_t>(high - low))];
        }
        Candidate candidates[FACE_PLANES + 3];
        int found = 0;
        const uint32_t shift = dice_.throw_below(size);
        for (uint32_t i = 0; i < size && found < FACE_PLANES; ++i) {
            // An odd step goes through a full sample as mixed as need be, and through smaller ones in order.
            const Piece& piece = sample[(shift + i * (size == SAMPLE ? 11u : 1u)) % size];
            bool had = is_slim(piece.source);
            for (int j = 0; j < found; ++j) had |= candidates[j].number == plane_of(piece);
            if (!had) candidates[found++] = plane_through(piece);
        }
        if (!found) {  // the sample has slim faces only; is_leaf has seen another
            const Piece* piece = pieces;
            while (is_slim(piece->source)) ++piece;
            candidates[found++] = plane_through(*piece);
        }
        const int of_faces = found;
        for (int axis = 0; with_axes && axis < 3; ++axis) {
            double at[SAMPLE];
            for (uint32_t i = 0; i < size; ++i) at[i] = point(pool_[static_cast<size_t>(sample[i].begin)])[axis];
            std::nth_element(at, at + size / 2, at + size);
            Candidate& along = candidates[found++];
            along = {{0.0, 0.0, 0.0, at[size / 2]}, -1};
            along.plane[axis] = 1.0;
        }
        int best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < found; ++i) {
            const double cost = score(sample, size, candidates[i], i >= of_faces, least);
            if (cost < least) least = cost, best = i;
        }
        return candidates[best];
    }

    // What a plane costs, or infinity where it is of no use or cannot be better than `least`.
    double score(const Piece* sample, uint32_t size, const Candidate& cut, bool axis, double least) const {
        uint32_t behind = 0, before = 0, across = 0;
        int32_t group[2] = {-1, -1};
        bool single[2] = {true, true};
        for (uint32_t i = 0; i < size; ++i) {
            const Where is = where(sample[i], cut);
            if (is == WITHIN) continue;
            behind += is != BEFORE;
            before += is != BEHIND;
            across += is == ACROSS;
            if (across * SPLIT_COST >= least) return std::numeric_limits<double>::infinity();
            const int32_t own = faces_.group[sample[i].source];
            for (int side = 0; side < 2; ++side) {
                if (is == (side ? BEHIND : BEFORE)) continue;
                if ((side ? before : behind) == 1) group[side] = own;
                single[side] &= own >= 0 && own == group[side];
            }
        }
        if (axis && std::max(behind, before) > LOPSIDED * size) return std::numeric_limits<double>::infinity();
        return SPLIT_COST * across + (single[0] ? 0.0 : WORK.of[behind]) + (single[1] ? 0.0 : WORK.of[before]);
    }

    // --- cuts ---

    void partition(const Piece* pieces, size_t n, const Candidate& cut) {
        within_.clear();
        behind_.clear();
        before_.clear();
        for (size_t i = 0; i < n; ++i) {
            const Piece piece = pieces[i];
            switch (where(piece, cut)) {
                case WITHIN: within_.push_back(piece); break;
                case BEHIND: behind_.push_back(piece); break;
                case BEFORE: before_.push_back(piece); break;
                case ACROSS: split(piece, cut.plane); break;
            }
        }
    }

    // What is within epsilon belongs to both sides; a new corner is always reckoned from the end behind the plane, so
    // that neighbours agree about it bit for bit.
    void split(const Piece& piece, const double* at) {
        const size_t size = static_cast<size_t>(piece.size);
        heights_.resize(size);
        for (size_t i = 0; i < size; ++i) heights_[i] = height(at, point(pool_[static_cast<size_t>(piece.begin) + i]));
        back_ring_.clear();
        front_ring_.clear();
        for (size_t i = 0; i < size; ++i) {
            const size_t j = i + 1 == size ? 0 : i + 1;
            const int32_t corner = pool_[static_cast<size_t>(piece.begin) + i];
            const int32_t next = pool_[static_cast<size_t>(piece.begin) + j];
            const double here = heights_[i], there = heights_[j];
            if (here <= epsilon_) back_ring_.push_back(corner);
            if (here >= -epsilon_) front_ring_.push_back(corner);
            if (std::min(here, there) >= -epsilon_ || std::max(here, there) <= epsilon_) continue;
            const int32_t made = here < 0.0 ? between(corner, here, next, there) : between(next, there, corner, here);
            back_ring_.push_back(made);
            front_ring_.push_back(made);
        }
        keep(back_ring_, piece.source, behind_);
        keep(front_ring_, piece.source, before_);
    }

    int32_t between(int32_t low, double below, int32_t high, double above) {
        const double share = below / (below - above);
        double made[3];
        for (int axis = 0; axis < 3; ++axis) {
            const double from = point(low)[axis];
            made[axis] = from + share * (point(high)[axis] - from);
        }
        const int32_t number = index(static_cast<size_t>(known_count_) + points.size() / 3);
        points.insert(points.end(), made, made + 3);
        return number;
    }

    void keep(const std::vector<int32_t>& ring, int32_t face, std::vector<Piece>& side) {
        if (ring.size() < 3) return;
        side.push_back({index(pool_.size()), static_cast<int32_t>(ring.size()), face});
        pool_.insert(pool_.end(), ring.begin(), ring.end());
    }
};

// ---------------------------------------------------------------------------------------------------------------------

// Pieces back to front: fragments, or the triangles that they are fanned into. A fragment of n corners has n - 2, so
// that the first one's number is that of its first corner less two for each fragment before it.
struct Painter {
    const OrderView& tree;
    const double* eye;
    const bool parallel;
    int64_t* out;
    int64_t* const end;
    std::vector<uint8_t> facing{};  // of planes, all at once: that is faster than to look for them one after the other
    std::vector<int64_t> late{};

    double before(const double* plane) const {
        return plane[0] * eye[0] + plane[1] * eye[1] + plane[2] * eye[2] - (parallel ? 0.0 : plane[3]);
    }

    int64_t piece(int64_t fragment) const { return tree.starts ? tree.starts[fragment] - 2 * fragment : fragment; }

    void write(int64_t first, int64_t last) {
        if (end - out >= 4) {  // most runs are short; four numbers are written faster than the end of a loop is guessed
            for (int64_t i = 0; i < 4; ++i) out[i] = first + i;
            const int64_t written = std::min<int64_t>(last - first, 4);
            out += written;
            first += written;
        }
        while (first < last) *out++ = first++;
    }

    // Of a convex body the faces that face away are farther; seen from inside, those that do not. Both are listed
    // without a branch that nobody could guess.
    void write_leaf(int64_t first, int64_t last, bool convex) {
        const size_t count = static_cast<size_t>(last - first);
        if (late.size() < count) late.resize(count);
        size_t earlier = 0, later = 0;
        for (int64_t i = first; i < last; ++i) {
            const bool is_late = facing[static_cast<size_t>(tree.plane_of[i])] == convex;
            out[earlier] = late[later] = i;
            earlier += !is_late;
            later += is_late;
        }
        out = std::copy_n(late.data(), later, out + earlier);
    }

    void paint() {
        facing.resize(static_cast<size_t>(tree.planes_count));
        for (size_t i = 0; i < facing.size(); ++i) facing[i] = before(tree.planes + 4 * i) > 0.0;
        std::vector<int64_t> waiting;  // nodes to go down to; ~node: its own fragments are next
        if (tree.root >= 0) waiting.push_back(tree.root);
        int64_t visits = 0;
        while (!waiting.empty()) {
            const int64_t next = waiting.back();
            waiting.pop_back();
            const OrderNode& node = tree.nodes[next < 0 ? ~next : next];
            const int64_t first = piece(node.first), last = piece(node.first + int64_t{node.count});
            if (last - first > end - out) throw Failure{NO_TREE};
            if (next < 0 || (node.kind != INNER && node.count == 1)) {
                write(first, last);
            } else if (++visits > tree.count) {
                throw Failure{NO_TREE};
            } else if (node.kind == INNER) {
                const bool at_front = before(node.plane) >= 0.0;
                const int64_t near = at_front ? node.front : node.back, far = at_front ? node.back : node.front;
                if (near >= 0) waiting.push_back(near);
                if (last > first) waiting.push_back(~next);
                if (far >= 0) waiting.push_back(far);
            } else {
                write_leaf(first, last, node.kind == CONVEX);
            }
        }
    }
};

// ---------------------------------------------------------------------------------------------------------------------
// The first face on a ray: the textbook's walk from front to back, as rays.py has it for a single one.

struct RaysView {
    const TreeView* tree;
    const double* planes;  // of the faces
    const int32_t* plane_of;
    const double* sides;      // (corners, 4) planes across the sides of fragments, looking inwards
    const int64_t* top;       // (nodes,) the box around a node's fragments; -1 where they are simply tried
    const double* boxes;      // (boxes, 6) low, high; those of fragments before those of others
    const int64_t* inside;    // (boxes, 2) the first box in it and how many
    const int64_t* fragments;  // of the first boxes
    int64_t leaves;           // how many of the boxes are of fragments
    double epsilon, size;
};

struct Caster {
    const RaysView& view;
    const double *origin = nullptr, *direction = nullptr;
    double begin = 0, end = 0, before = 0, distance = 0;
    int64_t face = -1;
    double inverse[3] = {0, 0, 0};

    struct Waiting {
        int32_t node;
        double begin, end;
        bool own;
    };
    std::vector<Waiting> waiting;
    std::vector<int64_t> opened;

    static double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

    void attempt(int64_t fragment) {
        const TreeView& tree = *view.tree;
        const int32_t source = tree.source[fragment];
        const double* plane = view.planes + 4 * int64_t{view.plane_of[source]};
        const double rise = dot(plane, direction), base = dot(plane, origin) - plane[3];
        const double one = base + rise * begin, two = base + rise * end;
        if (std::min(one, two) > view.epsilon || std::max(one, two) < -view.epsilon) return;
        if (!(std::abs(rise) * view.size > 2.0 * view.epsilon)) return;
        const double part = std::min(std::max(-base / rise, begin), end), away = part + before;
        if (away > distance || (away == distance && source >= face)) return;
        const double point[3] = {
            origin[0] + part * direction[0], origin[1] + part * direction[1], origin[2] + part * direction[2]};
        for (int32_t corner = tree.starts[fragment]; corner < tree.starts[fragment + 1]; ++corner)
            if (height(view.sides + 4 * int64_t{corner}, point) < -view.epsilon) return;
        distance = away;
        face = source;
    }

    bool meets(const double* box, double slack) const {
        double enters = begin, leaves = end;
        for (int axis = 0; axis < 3; ++axis) {
            const double one = (box[axis] - slack - origin[axis]) * inverse[axis];
            const double two = (box[axis + 3] + slack - origin[axis]) * inverse[axis];
            enters = std::max(enters, std::min(one, two));
            leaves = std::min(leaves, std::max(one, two));
        }
        return enters <= leaves && enters + before <= distance + slack;
    }

    void own(int32_t node, double slack) {
        const TreeView& tree = *view.tree;
        if (view.top[node] < 0) {
            for (int32_t k = 0; k < tree.count[node]; ++k) attempt(int64_t{tree.first[node]} + k);
            return;
        }
        opened.assign(1, view.top[node]);
        while (!opened.empty()) {
            const int64_t box = opened.back();
            opened.pop_back();
            if (!meets(view.boxes + 6 * box, slack)) continue;
            if (box < view.leaves) {
                attempt(view.fragments[box]);
                continue;
            }
            const int64_t* inside = view.inside + 2 * box;
            for (int64_t k = 0; k < inside[1]; ++k) opened.push_back(inside[0] + k);
        }
    }

    void cast(double slack) {
        const TreeView& tree = *view.tree;
        distance = std::numeric_limits<double>::infinity();
        face = -1;
        waiting.clear();
        if (tree.root < 0 || begin > end) return;
        for (int axis = 0; axis < 3; ++axis) {
            const double along = direction[axis];
            inverse[axis] = 1.0 / (std::abs(along) < 1e-200 ? 1e-200 : along);
        }
        waiting.push_back({static_cast<int32_t>(tree.root), begin, end, false});
        for (int64_t steps = 0; !waiting.empty(); ++steps) {
            if (steps > 4 * tree.nodes) throw Failure{NO_TREE};
            const Waiting now = waiting.back();
            waiting.pop_back();
            if (now.begin + before > distance + slack) continue;
            if (now.own || tree.kind[now.node] != INNER) {
                own(now.node, slack);
                continue;
            }
            const double* plane = tree.plane + 4 * int64_t{now.node};
            const double rise = dot(plane, direction), base = dot(plane, origin) - plane[3];
            const double one = base + rise * now.begin, two = base + rise * now.end;
            Waiting sides[2];
            int count = 0;
            for (int k = 0; k < 2; ++k) {  // the farther side first: it waits longer
                const bool front = (one < 0.0) == (k == 0);
                const double side = front ? 1.0 : -1.0;
                const int32_t child = front ? tree.front[now.node] : tree.back[now.node];
                if (child < 0 || std::max(side * one, side * two) < -slack) continue;
                const double cut = (-side * slack - base) / rise;
                sides[count++] = {child, side * one >= -slack ? now.begin : cut, side * two >= -slack ? now.end : cut,
                                  false};
            }
            const bool crosses = tree.count[now.node] > 0 && std::min(one, two) <= slack && std::max(one, two) >= -slack;
            if (!crosses) {
                waiting.insert(waiting.end(), sides, sides + count);
                continue;
            }
            const double arrives =
                std::abs(one) <= slack ? now.begin : now.begin + (std::abs(one) - slack) / std::abs(rise);
            int placed = 0;
            while (placed < count && sides[placed].begin >= arrives) waiting.push_back(sides[placed++]);
            waiting.push_back({now.node, arrives, now.end, true});
            while (placed < count) waiting.push_back(sides[placed++]);
        }
    }
};

template <class Function>
int32_t guarded(Function function) {
    try {
        function();
        return DONE;
    } catch (const Failure& failure) {
        return failure.status;
    } catch (const std::bad_alloc&) {
        return NO_MEMORY;
    } catch (const std::length_error&) {
        return TOO_MANY;
    }
}

template <class T>
void copied(const std::vector<T>& from, T* to) {
    if (!from.empty()) std::memcpy(to, from.data(), from.size() * sizeof(T));
}

}  // namespace

// ---------------------------------------------------------------------------------------------------------------------
// The border. A handle is what a build made; its sizes are asked for, its arrays copied out, and then it is freed.

// Raised by one with every change of what follows; native.py asks for its own.
BSP_API int32_t bsp_interface() { return 4; }

BSP_API int32_t bsp_build(const FacesView* faces, double epsilon, Progress progress, void** handle) {
    *handle = nullptr;
    return guarded([&] {
        Builder* builder = new Builder(*faces, epsilon, progress);
        *handle = builder;
        builder->build();
    });
}

// `faces` are those of the tree and then, from `first_new` on, the new ones; their points begin at `first_point`.
BSP_API int32_t bsp_insert(
    const FacesView* faces, const TreeView* tree, int32_t first_new, int64_t first_point, double epsilon,
    void** handle) {
    *handle = nullptr;
    return guarded([&] {
        Builder* builder = new Builder(*faces, epsilon, nullptr);
        *handle = builder;
        builder->insert(*tree, first_new, first_point);
    });
}

// (5,) new points, new corners, new fragments, nodes, root.
BSP_API void bsp_sizes(const void* handle, int64_t* sizes) {
    const Builder& made = *static_cast<const Builder*>(handle);
    sizes[0] = static_cast<int64_t>(made.points.size() / 3);
    sizes[1] = static_cast<int64_t>(made.corners.size());
    sizes[2] = static_cast<int64_t>(made.source.size());
    sizes[3] = static_cast<int64_t>(made.kind.size());
    sizes[4] = made.root;
}

BSP_API void bsp_copy(
    const void* handle, double* points, int32_t* corners, int32_t* ends, int32_t* source, double* plane, int32_t* front,
    int32_t* back, int32_t* first, int32_t* count, int8_t* kind) {
    const Builder& made = *static_cast<const Builder*>(handle);
    copied(made.points, points);
    copied(made.corners, corners);
    copied(made.ends, ends);
    copied(made.source, source);
    copied(made.plane, plane);
    copied(made.front, front);
    copied(made.back, back);
    copied(made.first, first);
    copied(made.count, count);
    copied(made.kind, kind);
}

BSP_API void bsp_free(void* handle) { delete static_cast<Builder*>(handle); }

// How many pieces were written to `out`, or minus a status.
BSP_API int64_t bsp_order(
    const OrderView* tree, const double* eye, int32_t parallel, int32_t front_first, int64_t* out, int64_t room) {
    Painter painter{*tree, eye, parallel != 0, out, out + room};
    const int32_t status = guarded([&] { painter.paint(); });
    if (status != DONE) return -static_cast<int64_t>(status);
    if (front_first) std::reverse(out, painter.out);
    return painter.out - out;
}

// Of rays, as lines.py has them, the distance (n,) and the face (n,) of the first hit; infinite and -1 for a miss.
BSP_API int32_t bsp_first_hits(
    const RaysView* view, const double* origin, const double* direction, const double* begin, const double* end,
    const double* before, int64_t count, double slack, double* distance, int64_t* face) {
    return guarded([&] {
        Caster caster{*view};
        for (int64_t ray = 0; ray < count; ++ray) {
            caster.origin = origin + 3 * ray;
            caster.direction = direction + 3 * ray;
            caster.begin = begin[ray];
            caster.end = end[ray];
            caster.before = before[ray];
            caster.cast(slack);
            distance[ray] = caster.distance;
            face[ray] = caster.face;
        }
    });
}

// The triangles (t, 3) that fragments are fanned into, by place in the corners, and the fragment of each.
BSP_API void bsp_fans(const int32_t* starts, int64_t fragments, int64_t* fans, int64_t* fragment_of) {
    for (int64_t fragment = 0; fragment < fragments; ++fragment)
        for (int64_t corner = starts[fragment] + int64_t{1}; corner + 1 < starts[fragment + 1]; ++corner) {
            *fans++ = starts[fragment];
            *fans++ = corner;
            *fans++ = corner + 1;
            *fragment_of++ = fragment;
        }
}

// Where a compiler's linker wants to see an extension module of Python (Windows). It is not one; importing it fails.
BSP_API void* PyInit_bsp() { return nullptr; }
