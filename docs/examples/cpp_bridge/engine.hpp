// The engine under test: planes and polygons of docs/retail (01 5-6, 02). Yours is elsewhere; what matters
// here is bridge.cpp, which asks it.
//
// Retail's fields are floats and its registers doubles: every store() below is one of retail's stores, and
// every sum is written in retail's order.

#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace engine {

constexpr double EPS = 0.0002f;              // 01 0: F_EPSILON
constexpr float LEAST_WALK_INTERP = -0.5f;   // 02 AS-4
constexpr double CELL_EDGE = 24.0;           // metres

inline float store(double x) { return static_cast<float>(x); }

struct Vec { float x = 0, y = 0, z = 0; };
struct Sphere { Vec center; float radius = 0; };
struct Plane { Vec n; float d = 0; };
struct Position { uint32_t cell = 0; Vec origin; float m[9] = {}; };

inline double dot(const Vec& a, const Vec& b) {  // x last
    return (double(a.y) * b.y + double(a.z) * b.z) + double(a.x) * b.x;
}

inline double distance(const Plane& plane, const Vec& point) { return dot(point, plane.n) + plane.d; }

// Frame::cache, 01 4.2: the rotation is w, x, y, z.
inline Position make_position(uint32_t cell, const Vec& origin, const float (&q)[4]) {
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double x2 = x + x, y2 = y + y, z2 = z + z;
    const double wx = w * x2, wy = w * y2, wz = w * z2;
    const double xx = x * x2, xy = x * y2, xz = x * z2;
    const double yy = y * y2, yz = y * z2, zz = z * z2;
    return {cell, origin,
            {store((1.0 - yy) - zz), store(xy + wz), store(xz - wy),
             store(xy - wz), store((1.0 - xx) - zz), store(yz + wx),
             store(xz + wy), store(yz - wx), store((1.0 - xx) - yy)}};
}

// LandDefs::get_block_offset, 10 2.6.
inline Vec block_offset(uint32_t from, uint32_t to) {
    if (from >> 16 == to >> 16) return {};
    const auto x = [](uint32_t id) { return int(id >> 21 & 0x7F8); };
    const auto y = [](uint32_t id) { return 8 * int(id >> 16 & 0xFF); };
    return {store((x(to) - x(from)) * CELL_EDGE), store((y(to) - y(from)) * CELL_EDGE), 0};
}

// Position::localtoglobal, 01 5.3: two roundings a component.
inline Vec localtoglobal(uint32_t to, const Position& p, const Vec& v) {
    const float* m = p.m;
    const Vec g = {store(((double(m[3]) * v.y + double(m[0]) * v.x) + double(m[6]) * v.z) + p.origin.x),
                   store(((double(m[4]) * v.y + double(m[1]) * v.x) + double(m[7]) * v.z) + p.origin.y),
                   store(((double(m[5]) * v.y + double(m[2]) * v.x) + double(m[8]) * v.z) + p.origin.z)};
    const Vec off = block_offset(to, p.cell);
    return {store(double(off.x) + g.x), store(double(off.y) + g.y), store(double(off.z) + g.z)};
}

// Plane::localtoglobal, 01 PL-1...PL-4.
inline Plane localtoglobal(uint32_t to, const Position& from, const Plane& plane) {
    const Vec& N = plane.n;
    const float* m = from.m;
    const double nd = -double(plane.d);
    const Vec foot = {store(nd * N.x), store(nd * N.y), store(nd * N.z)};
    const Vec n = {store((double(m[6]) * N.z + double(m[3]) * N.y) + double(m[0]) * N.x),
                   store((double(m[7]) * N.z + double(m[4]) * N.y) + double(m[1]) * N.x),
                   store((double(m[8]) * N.z + double(m[5]) * N.y) + double(m[2]) * N.x)};
    return {n, store(-dot(n, localtoglobal(to, from, foot)))};
}

// Plane::snap_to_plane, 01 6.4.
inline void snap_to_plane(const Plane& plane, Vec& offset) {
    const Vec& N = plane.n;
    if (!(std::fabs(N.z) > EPS)) return;
    const double s = ((double(offset.y) * N.y + double(offset.x) * N.x) + N.z * 0.0) + plane.d;
    offset.z = store((-s) * (1.0 / N.z) - (1.0 / N.z) * (-double(plane.d)));
}

struct Polygon {
    std::vector<Vec> vertices;
    Plane plane;

    explicit Polygon(std::vector<Vec> corners) : vertices(std::move(corners)) { make_plane(); }

    // MP-1...MP-6.
    void make_plane() {
        double sx = 0, sy = 0, sz = 0;
        for (size_t k = 1; k + 1 < vertices.size(); ++k) {
            const Vec &p0 = vertices[0], &a = vertices[k], &b = vertices[k + 1];
            const double bx = double(b.x) - p0.x, by = double(b.y) - p0.y, bz = double(b.z) - p0.z;
            const float ax = store(double(a.x) - p0.x), ay = store(double(a.y) - p0.y);
            const double az = double(a.z) - p0.z;
            sx += store(ay * bz - az * by);
            sy += store(az * bx - bz * ax);
            sz = store((by * ax - ay * bx) + sz);
        }
        const double inv = 1.0 / std::sqrt((sz * sz + sy * sy) + sx * sx);
        const float inv32 = store(inv);
        plane.n = {store(inv * sx), store(inv32 * sy), store(inv32 * sz)};
        double total = 0;
        for (const Vec& v : vertices)
            total = ((total + double(plane.n.z) * v.z) + double(plane.n.y) * v.y) + double(plane.n.x) * v.x;
        plane.d = store(-(total / double(vertices.size())));
    }

    // P2-1...P2-4: `side` is 0 for the positive one.
    bool point_in_poly2D(const Vec& point, int side) const {
        if (vertices.empty()) return true;
        const Vec* prev = &vertices.front();
        for (auto cur = vertices.rbegin(); cur != vertices.rend(); ++cur) {
            const double a = double(prev->y) - cur->y, b = double(cur->x) - prev->x;
            const double s = ((-(a * cur->x) - b * cur->y) + b * point.y) + a * point.x;
            if (side == 0 ? s > 0.0 : s < 0.0) return false;
            prev = &*cur;
        }
        return true;
    }

    // PP-1...PP-3.
    bool point_in_polygon(const Vec& point) const {
        const Vec& N = plane.n;
        const Vec* prev = vertices.empty() ? nullptr : &vertices.back();
        for (const Vec& cur : vertices) {
            const double ex = double(cur.x) - prev->x, ey = double(cur.y) - prev->y, ez = double(cur.z) - prev->z;
            const float cx = store(ez * N.y - ey * N.z), cy = store(ex * N.z - ez * N.x);
            const double cz = ey * N.x - ex * N.y;
            const double s = ((double(point.z) - prev->z) * cz + (double(point.y) - prev->y) * cy)
                             + (double(point.x) - prev->x) * cx;
            if (s < 0.0) return false;
            prev = &cur;
        }
        return true;
    }

    // The loop of PH-4...PH-7, SS-5...SS-6 and CW-5...CW-7; `inside` is the answer inside every edge.
    bool reached_edge_by_edge(const Vec& p, double rsq, bool inside) const {
        const Vec& N = plane.n;
        bool result = inside;
        const Vec* prev = vertices.empty() ? nullptr : &vertices.back();
        for (const Vec& cur : vertices) {
            const float ex = store(double(cur.x) - prev->x), ey = store(double(cur.y) - prev->y);
            const double ez = double(cur.z) - prev->z, qz = double(p.z) - prev->z;
            const float qx = store(double(p.x) - prev->x), qy = store(double(p.y) - prev->y);
            const float ez32 = store(ez), qz32 = store(qz);
            const double cz = double(ey) * N.x - double(ex) * N.y;
            const double cy = double(ex) * N.z - double(ez32) * N.x;
            const double cx = ez * N.y - double(ey) * N.z;
            const double side = (qz * cz + qy * cy) + qx * cx;
            if (side < 0.0) {
                const double cross2 = (cx * cx + cy * cy) + cz * cz;
                if (cross2 * rsq < side * side) return false;
                const double along = (double(qz32) * ez32 + double(qy) * ey) + double(qx) * ex;
                if (0.0 <= along && along <= (double(ez32) * ez32 + double(ey) * ey) + double(ex) * ex) return true;
                result = false;
            }
            if ((double(qz32) * qz32 + double(qy) * qy) + double(qx) * qx <= rsq) return true;
            prev = &cur;
        }
        return result;
    }

    // polygon_hits_sphere (PH) and polygon_hits_sphere_slow_but_sure (SS); `touched`: contact was written.
    bool hits_sphere(const Sphere& s, bool slow, Vec& contact, bool& touched) const {
        const double dist = distance(plane, s.center), rad = s.radius - EPS;
        touched = !(rad < std::fabs(dist));
        if (!touched) return false;
        const double rsq = store(rad * rad - dist * dist);
        const float pz = store(dist * plane.n.z);
        contact = {store(s.center.x - dist * plane.n.x), store(s.center.y - dist * plane.n.y),
                   store(double(s.center.z) - pz)};
        if (slow && point_in_polygon(contact)) return true;
        return reached_edge_by_edge(contact, rsq, !slow);
    }

    // CW-2, CW-3, FE-2: along `up` onto the plane.
    Vec along_up(const Vec& center, const Vec& up, double v) const {
        const double t = distance(plane, center) / v;
        const float ty = store(t * up.y), tz = store(t * up.z);
        return {store(center.x - t * up.x), store(double(center.y) - ty), store(double(center.z) - tz)};
    }

    // check_walkable (CW-1...CW-7); check_small_walkable with a share of 0.25.
    bool check_walkable(const Sphere& s, const Vec& up, double share) const {
        const double v = dot(plane.n, up);
        if (std::fabs(v) < EPS) return false;
        return reached_edge_by_edge(along_up(s.center, up, v), store((double(s.radius) * s.radius) * share), true);
    }

    // FE-1...FE-5: the normal of the first edge that the centre is outside of.
    bool find_crossed_edge(const Sphere& s, const Vec& up, Vec& normal) const {
        const Vec& N = plane.n;
        const double v = dot(N, up);
        if (std::fabs(v) < EPS) return false;
        const Vec p = along_up(s.center, up, v);
        const Vec* prev = vertices.empty() ? nullptr : &vertices.back();
        for (const Vec& cur : vertices) {
            const float ex = store(double(cur.x) - prev->x), ey = store(double(cur.y) - prev->y);
            const double ez = double(cur.z) - prev->z;
            const float ez32 = store(ez);
            const double side = ((double(p.z) - prev->z) * (double(ey) * N.x - double(ex) * N.y)
                                 + (double(p.y) - prev->y) * (double(ex) * N.z - double(ez32) * N.x))
                                + (double(p.x) - prev->x) * (ez * N.y - double(ey) * N.z);
            if (side < 0.0) {
                const Vec n = {store(double(ez32) * N.y - double(ey) * N.z),
                               store(double(ex) * N.z - double(ez32) * N.x),
                               store(double(ey) * N.x - double(ex) * N.y)};
                const double inv = 1.0 / std::sqrt((double(n.x) * n.x + double(n.y) * n.y) + double(n.z) * n.z);
                normal = {store(inv * n.x), store(inv * n.y), store(inv * n.z)};
                return true;
            }
            prev = &cur;
        }
        return false;
    }

    // AS-1...AS-6.
    bool adjust_sphere_to_plane(Sphere& s, const Vec& movement, float& walk_interp) const {
        const double dist = distance(plane, s.center), v = dot(movement, plane.n);
        double num = 0;
        if (v > EPS) num = -double(s.radius) - dist;
        else if (v >= -EPS) return false;
        else num = dist - s.radius;
        const double t = num / v, w = (1.0 - t) * walk_interp;
        const float w32 = store(w);
        if (w >= walk_interp || w32 < LEAST_WALK_INTERP) return false;
        const float oy = store(t * movement.y), oz = store(t * movement.z);
        s.center = {store(s.center.x - t * movement.x), store(double(s.center.y) - oy),
                    store(double(s.center.z) - oz)};
        walk_interp = w32;
        return true;
    }

    // AP-1...AP-5.
    double adjust_sphere_to_poly(float radius, const Vec& curr, const Vec& movement) const {
        const float dist0 = store(distance(plane, curr));
        if (std::fabs(dist0) < radius) return 1.0;
        const double v = dot(movement, plane.n);
        if (std::fabs(v) < EPS) return 0.0;
        return ((dist0 <= 0.0f ? -double(radius) : double(radius)) - dist0) / v;
    }

    // AQ-1...AQ-4.
    void adjust_to_placement(Vec& struck, Vec& other, float radius, bool center_solid, bool solid_check) const {
        const Vec& N = plane.n;
        const double dist = distance(plane, struck);
        double r = radius;
        if (solid_check) {
            if (center_solid) r = r * -1.0;
            if (dist <= 0.0) r = -r;
        }
        const double k = r - dist, ox = k * N.x;
        const float oy = store(k * N.y), oz = store(k * N.z);
        for (Vec* c : {&struck, &other})
            *c = {store(ox + c->x), store(double(oy) + c->y), store(double(oz) + c->z)};
    }
};

}  // namespace engine
