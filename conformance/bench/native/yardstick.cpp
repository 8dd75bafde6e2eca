// The two hot kernels in C++, from docs/retail (02, 03): a yardstick for speed, and a third opinion on the
// bits. Retail's fields are floats, its registers are doubles here; a store rounds once.
//
// Nothing that is installed uses this file: `conformance bench --native` compiles it with the system's
// compiler. The flags matter (see compiler.py): vectorised, a round trip through float is optimised away.

#include <cmath>
#include <cstdint>
#include <vector>

#if defined(_WIN32)
#define API extern "C" __declspec(dllexport)
#else
#define API extern "C" __attribute__((visibility("default")))
#endif

namespace {

constexpr double EPS = 0.0002f;            // 01 0: F_EPSILON
constexpr float WALK_INTERP_FLOOR = -0.5f;  // AS-4

struct Vec { float x, y, z; };
struct Sphere { Vec center; float radius; };
struct Plane { Vec n; float d; };

struct Polygon {
    Plane plane;
    const Vec* vertices;
    int32_t count;
    int32_t id;
};

struct Node {
    Plane plane;             // of an interior node
    Sphere sphere;
    const Node* positive;    // null: a leaf
    const Node* negative;
    const Polygon* const* polygons;
    int32_t count;
};

inline float store(double x) { return static_cast<float>(x); }

inline double distance(const Plane& p, const Vec& v) {  // 01 1.2
    return (double(p.n.y) * v.y + double(p.n.z) * v.z) + double(p.n.x) * v.x + p.d;
}

inline double along(const Vec& n, const Vec& v) {
    return (double(v.y) * n.y + double(v.z) * n.z) + double(v.x) * n.x;
}

inline bool intersects(const Sphere& a, const Sphere& b) {  // CSphere::intersects, 01 3.1
    const double dx = double(a.center.x) - b.center.x;
    const double dy = double(a.center.y) - b.center.y;
    const double dz = double(a.center.z) - b.center.z;
    const double r = double(b.radius) + a.radius;
    return ((dx * dx + dy * dy) + dz * dz) - r * r < EPS;
}

bool point_in_polygon(const Polygon& p, const Vec& c) {  // PP-1...PP-3
    const Vec& n = p.plane.n;
    const Vec* prev = &p.vertices[p.count - 1];
    for (int i = 0; i < p.count; ++i) {
        const Vec* cur = &p.vertices[i];
        const double ex = double(cur->x) - prev->x;
        const double ey = double(cur->y) - prev->y;
        const double ez = double(cur->z) - prev->z;
        const float cx = store(ez * n.y - ey * n.z);
        const float cy = store(ex * n.z - ez * n.x);
        const double cz = ey * n.x - ex * n.y;
        const double side = ((double(c.z) - prev->z) * cz + (double(c.y) - prev->y) * cy)
                            + (double(c.x) - prev->x) * cx;
        if (side < 0.0) return false;
        prev = cur;
    }
    return true;
}

bool any_edge_near(const Polygon& p, const Vec& c, float rsq) {  // SS-5, SS-6
    const Vec& n = p.plane.n;
    const Vec* prev = &p.vertices[p.count - 1];
    for (int i = 0; i < p.count; ++i) {
        const Vec* cur = &p.vertices[i];
        const float ex = store(double(cur->x) - prev->x);
        const float ey = store(double(cur->y) - prev->y);
        const double ez = double(cur->z) - prev->z;
        const float ezs = store(ez);
        const float qx = store(double(c.x) - prev->x);
        const float qy = store(double(c.y) - prev->y);
        const double qz = double(c.z) - prev->z;
        const float qzs = store(qz);
        const double cz = double(ey) * n.x - double(ex) * n.y;
        const double cy = double(ex) * n.z - double(ezs) * n.x;
        const double cx = ez * n.y - double(ey) * n.z;
        const double side = (qz * cz + qy * cy) + qx * cx;
        if (side < 0.0) {
            if (((cx * cx + cy * cy) + cz * cz) * rsq < side * side) return false;
            const double t = (double(qzs) * ezs + double(qy) * ey) + double(qx) * ex;
            if (t >= 0.0 && t <= (double(ezs) * ezs + double(ey) * ey) + double(ex) * ex) return true;
        }
        if ((double(qzs) * qzs + double(qy) * qy) + double(qx) * qx <= rsq) return true;
        prev = cur;
    }
    return false;
}

bool hits_sphere(const Polygon& p, const Sphere& s) {  // polygon_hits_sphere_slow_but_sure, SS-1...SS-6
    const double dist = distance(p.plane, s.center);
    const double rad = s.radius - EPS;
    if (rad < std::fabs(dist)) return false;
    const float pz = store(dist * p.plane.n.z);
    const Vec c = {store(s.center.x - dist * p.plane.n.x), store(s.center.y - dist * p.plane.n.y),
                   store(double(s.center.z) - pz)};
    if (point_in_polygon(p, c)) return true;
    return any_edge_near(p, c, store(rad * rad - dist * dist));
}

// BSPNODE::sphere_intersects_poly, SP-1...SP-6; `poly` is the last polygon that overlapped.
bool strikes(const Node* node, const Sphere& s, const Vec& movement, const Polygon*& poly) {
    if (node->positive == nullptr) {
        if (node->count == 0 || !intersects(node->sphere, s)) return false;
        for (int i = 0; i < node->count; ++i) {
            const Polygon* p = node->polygons[i];
            if (hits_sphere(*p, s)) {
                poly = p;
                if (along(p->plane.n, movement) < 0.0) return true;  // PS-3
            }
        }
        return false;
    }
    if (!intersects(node->sphere, s)) return false;
    const double dist = distance(node->plane, s.center);
    const double reach = s.radius - EPS;
    if (dist >= reach) return strikes(node->positive, s, movement, poly);
    if (dist <= -reach) return strikes(node->negative, s, movement, poly);
    return strikes(node->positive, s, movement, poly) || strikes(node->negative, s, movement, poly);
}

struct Down {  // what one step down reads and changes
    Sphere sphere;
    Vec movement;
    Vec up;
    float allowance;
    float interp;
    const Polygon* poly;
};

bool adjust_to_plane(const Polygon& p, Down& q) {  // AS-1...AS-6
    const double dist = distance(p.plane, q.sphere.center);
    const double v = along(p.plane.n, q.movement);
    double num;
    if (v > EPS) num = -double(q.sphere.radius) - dist;
    else if (v >= -EPS) return false;
    else num = dist - q.sphere.radius;
    const double t = num / v;
    const double w = (1.0 - t) * q.interp;
    const float ws = store(w);
    if (w >= q.interp || ws < WALK_INTERP_FLOOR) return false;
    const float oy = store(t * q.movement.y);
    const float oz = store(t * q.movement.z);
    q.sphere.center = {store(q.sphere.center.x - t * q.movement.x), store(double(q.sphere.center.y) - oy),
                       store(double(q.sphere.center.z) - oz)};
    q.interp = ws;
    return true;
}

void find_walkable(const Node* node, Down& q) {  // BSPNODE::find_walkable, FW-1...FW-5
    if (node->positive == nullptr) {
        if (node->count == 0 || !intersects(node->sphere, q.sphere)) return;
        for (int i = 0; i < node->count; ++i) {
            const Polygon& p = *node->polygons[i];
            if (along(p.plane.n, q.up) > q.allowance && hits_sphere(p, q.sphere) && adjust_to_plane(p, q))
                q.poly = &p;
        }
        return;
    }
    if (!intersects(node->sphere, q.sphere)) return;
    const double dist = distance(node->plane, q.sphere.center);
    const double reach = q.sphere.radius - EPS;
    if (dist >= reach) return find_walkable(node->positive, q);
    if (dist <= -reach) return find_walkable(node->negative, q);
    find_walkable(node->positive, q);
    find_walkable(node->negative, q);
}

}  // namespace

struct Tree {
    std::vector<Vec> corners;
    std::vector<Polygon> polygons;
    std::vector<const Polygon*> lists;
    std::vector<Node> nodes;
};

namespace {

// Corners lie polygon by polygon, so that an edge walk reads consecutive memory.
void take_polygons(Tree& tree, const float* vertices, const float* planes, const int32_t* corners,
                   const int32_t* starts, int64_t count) {
    tree.corners.reserve(static_cast<size_t>(starts[count]));
    tree.polygons.reserve(static_cast<size_t>(count));
    for (int64_t p = 0; p < count; ++p) {
        const Vec* first = tree.corners.data() + tree.corners.size();
        for (int32_t k = starts[p]; k < starts[p + 1]; ++k) {
            const float* v = vertices + 3 * corners[k];
            tree.corners.push_back({v[0], v[1], v[2]});
        }
        const float* n = planes + 4 * p;
        tree.polygons.push_back(
            {{{n[0], n[1], n[2]}, n[3]}, first, starts[p + 1] - starts[p], static_cast<int32_t>(p)});
    }
}

void take_nodes(Tree& tree, const float* floats, const int32_t* ints, int64_t count) {
    tree.nodes.resize(static_cast<size_t>(count));
    for (int64_t i = 0; i < count; ++i) {
        const float* f = floats + 8 * i;
        const int32_t* n = ints + 4 * i;
        const bool leaf = n[0] < 0;
        tree.nodes[i] = {{{f[0], f[1], f[2]}, f[3]}, {{f[4], f[5], f[6]}, f[7]},
                         leaf ? nullptr : &tree.nodes[n[0]], leaf ? nullptr : &tree.nodes[n[1]],
                         tree.lists.data() + n[2], n[3]};
    }
}

}  // namespace

// vertices: 3 floats each; planes: 4 floats a polygon; corners: vertex indices of all polygons, those of
// polygon p from corner_starts[p] on; nodes: 8 floats (plane, sphere) and 4 ints (positive child or -1 for a
// leaf, negative child, first and number of its polygons in lists) each, the root first.
API Tree* tree_new(const float* vertices, const float* planes, const int32_t* corners,
                   const int32_t* corner_starts, int64_t num_polygons, const float* node_floats,
                   const int32_t* node_ints, int64_t num_nodes, const int32_t* lists, int64_t num_lists) {
    Tree* tree = new Tree;
    take_polygons(*tree, vertices, planes, corners, corner_starts, num_polygons);
    tree->lists.reserve(static_cast<size_t>(num_lists));
    for (int64_t i = 0; i < num_lists; ++i) tree->lists.push_back(&tree->polygons[lists[i]]);
    take_nodes(*tree, node_floats, node_ints, num_nodes);
    return tree;
}

API void tree_delete(Tree* tree) { delete tree; }

// spheres: 4 floats, movements: 3 floats a query; struck: 0/1, poly: id or -1.
API void strike_many(const Tree* tree, const float* spheres, const float* movements, int64_t count,
                     int32_t* struck, int32_t* poly) {
    for (int64_t i = 0; i < count; ++i) {
        const float* s = spheres + 4 * i;
        const float* m = movements + 3 * i;
        const Polygon* p = nullptr;
        struck[i] = strikes(&tree->nodes[0], {{s[0], s[1], s[2]}, s[3]}, {m[0], m[1], m[2]}, p) ? 1 : 0;
        poly[i] = p ? p->id : -1;
    }
}

// ups: 3 floats; limits: walkable allowance and walk_interp; moved: centre and walk_interp.
API void step_down_many(const Tree* tree, const float* spheres, const float* movements, const float* ups,
                        const float* limits, int64_t count, float* moved, int32_t* poly) {
    for (int64_t i = 0; i < count; ++i) {
        const float* s = spheres + 4 * i;
        const float* m = movements + 3 * i;
        const float* u = ups + 3 * i;
        Down q = {{{s[0], s[1], s[2]}, s[3]}, {m[0], m[1], m[2]}, {u[0], u[1], u[2]},
                  limits[2 * i], limits[2 * i + 1], nullptr};
        find_walkable(&tree->nodes[0], q);
        moved[4 * i] = q.sphere.center.x;
        moved[4 * i + 1] = q.sphere.center.y;
        moved[4 * i + 2] = q.sphere.center.z;
        moved[4 * i + 3] = q.interp;
        poly[i] = q.poly ? q.poly->id : -1;
    }
}
