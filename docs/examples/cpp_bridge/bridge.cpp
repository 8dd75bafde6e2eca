// A bridge of protocol v1 (docs/plugging-in-an-engine.md): one JSON object a line on stdin, one reply a line
// on stdout, in order. It performs the operations of planes and polygons and skips all others.
//
//   cmake -B build && cmake --build build
//   conformance smoke build/bridge
//   pytest conformance --candidate cmd:build/bridge

#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "engine.hpp"

using engine::Plane;
using engine::Polygon;
using engine::Position;
using engine::Sphere;
using engine::Vec;
using nlohmann::json;

namespace {

// --- Reading inputs. A float is a decimal that rounds to it, or one of three texts. -------------------

double number(const json& value) {
    if (!value.is_string()) return value.get<double>();
    if (value == "nan") return std::nan("");
    return value == "inf" ? INFINITY : -INFINITY;
}

float f32(const json& value) { return static_cast<float>(number(value)); }
Vec vec(const json& v) { return {f32(v.at(0)), f32(v.at(1)), f32(v.at(2))}; }
Sphere sphere(const json& s) { return {vec(s), f32(s.at(3))}; }
Plane plane(const json& p) { return {vec(p), f32(p.at(3))}; }

Position position(const json& pose) {
    const json& q = pose.at("rotation");
    const float rotation[4] = {f32(q.at(0)), f32(q.at(1)), f32(q.at(2)), f32(q.at(3))};
    return engine::make_position(pose.at("cell").get<uint32_t>(), vec(pose.at("origin")), rotation);
}

// --- Writing results. --------------------------------------------------------------------------------

json number(double x) {
    if (std::isnan(x)) return "nan";
    if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
    return x;
}

json array(const Vec& v) { return {number(v.x), number(v.y), number(v.z)}; }
json array(const Plane& p) { return {number(p.n.x), number(p.n.y), number(p.n.z), number(p.d)}; }
json array_or_null(bool there, const Vec& v) { return there ? array(v) : json(nullptr); }

// --- The operations of FORMAT.md. --------------------------------------------------------------------

using Geometry = std::vector<Polygon>;
using Scene = std::map<std::string, Geometry>;  // geometry by name
using Operation = std::function<json(const json& inputs, const Scene& scene)>;
using PolygonOperation = std::function<json(const json& inputs, const Polygon& polygon)>;

json hits_sphere(const json& in, const Polygon& p, bool slow) {
    Vec contact;
    bool touched = false;
    const bool r = p.hits_sphere(sphere(in.at("sphere")), slow, contact, touched);
    return {{"r", int(r)}, {"contact", array_or_null(touched, contact)}};
}

json pos_hits_sphere(const json& in, const Polygon& p) {  // PS-1...PS-3
    json result = hits_sphere(in, p, true);
    result["struck"] = result["r"];
    if (engine::dot(vec(in.at("movement")), p.plane.n) >= 0.0) result["r"] = 0;
    return result;
}

json walkable_hits_sphere(const json& in, const Polygon& p) {  // WH-1, WH-2
    if (!(engine::dot(p.plane.n, vec(in.at("up"))) > f32(in.at("walkable_allowance")))) return {{"r", 0}};
    return {{"r", hits_sphere(in, p, true).at("r")}};
}

json find_crossed_edge(const json& in, const Polygon& p) {
    Vec normal;
    const bool r = p.find_crossed_edge(sphere(in.at("sphere")), vec(in.at("up")), normal);
    return {{"r", int(r)}, {"normal", array_or_null(r, normal)}};
}

json adjust_sphere_to_plane(const json& in, const Polygon& p) {
    Sphere s = sphere(in.at("sphere"));
    float walk_interp = f32(in.at("walk_interp"));
    const bool r = p.adjust_sphere_to_plane(s, vec(in.at("movement")), walk_interp);
    return {{"r", int(r)}, {"center", array(s.center)}, {"walk_interp", number(walk_interp)}};
}

json adjust_sphere_to_poly(const json& in, const Polygon& p) {
    const float radius = sphere(in.at("sphere")).radius;
    return {{"t", number(p.adjust_sphere_to_poly(radius, vec(in.at("curr")), vec(in.at("movement"))))}};
}

json adjust_to_placement_poly(const json& in, const Polygon& p) {
    Vec struck = sphere(in.at("sphere")).center, other = sphere(in.at("other")).center;
    p.adjust_to_placement(struck, other, f32(in.at("radius")), in.at("center_solid").get<int>() != 0,
                          in.at("solid_check").get<int>() != 0);
    return {{"center", array(struck)}, {"other_center", array(other)}};
}

json check_walkable(const json& in, const Polygon& p, double share) {
    return {{"r", int(p.check_walkable(sphere(in.at("sphere")), vec(in.at("up")), share))}};
}

json plane_localtoglobal(const json& in, const Scene&) {
    const uint32_t to = in.at("to").at("cell").get<uint32_t>();
    return {{"plane", array(engine::localtoglobal(to, position(in.at("from")), plane(in.at("plane"))))}};
}

json snap_to_plane(const json& in, const Scene&) {
    Vec v = vec(in.at("v"));
    engine::snap_to_plane(plane(in.at("plane")), v);
    return {{"v", array(v)}};
}

Operation of_polygon(PolygonOperation operation) {
    return [operation](const json& in, const Scene& scene) {
        const Geometry& geometry = scene.at(in.at("geometry").get<std::string>());
        return operation(in, geometry.at(in.at("poly").get<size_t>()));
    };
}

const std::map<std::string, Operation> OPERATIONS = {
    {"plane_localtoglobal", plane_localtoglobal},
    {"snap_to_plane", snap_to_plane},
    {"polygon_make_plane", of_polygon([](const json&, const Polygon& p) -> json {
         return {{"plane", array(p.plane)}};
     })},
    {"polygon_point_in_polygon", of_polygon([](const json& in, const Polygon& p) -> json {
         return {{"r", int(p.point_in_polygon(vec(in.at("point"))))}};
     })},
    {"polygon_point_in_poly2D", of_polygon([](const json& in, const Polygon& p) -> json {
         return {{"r", int(p.point_in_poly2D(vec(in.at("point")), in.at("side").get<int>()))}};
     })},
    {"polygon_hits_sphere_fast",
     of_polygon([](const json& in, const Polygon& p) { return hits_sphere(in, p, false); })},
    {"polygon_hits_sphere_slow",
     of_polygon([](const json& in, const Polygon& p) { return hits_sphere(in, p, true); })},
    {"polygon_pos_hits_sphere", of_polygon(pos_hits_sphere)},
    {"polygon_walkable_hits_sphere", of_polygon(walkable_hits_sphere)},
    {"polygon_check_walkable",
     of_polygon([](const json& in, const Polygon& p) { return check_walkable(in, p, 1.0); })},
    {"polygon_check_small_walkable",
     of_polygon([](const json& in, const Polygon& p) { return check_walkable(in, p, 0.25); })},
    {"polygon_find_crossed_edge", of_polygon(find_crossed_edge)},
    {"polygon_adjust_sphere_to_plane", of_polygon(adjust_sphere_to_plane)},
    {"polygon_adjust_sphere_to_poly", of_polygon(adjust_sphere_to_poly)},
    {"polygon_adjust_to_placement_poly", of_polygon(adjust_to_placement_poly)},
};

// --- The protocol. -----------------------------------------------------------------------------------

json introduction() {
    json ops = json::array();
    for (const auto& [name, operation] : OPERATIONS) ops.push_back(name);
    return {{"version", 1}, {"name", "cpp-bridge 1.0"}, {"floats", "decimal"}, {"ops", ops},
            {"features", {"not-finite"}}};
}

Scene read_scene(const json& message) {
    Scene scene;
    for (const json& record : message.at("geometries")) {
        Geometry geometry;
        for (const json& polygon : record.at("polygons")) {
            std::vector<Vec> corners;
            for (const json& index : polygon.at("v")) corners.push_back(vec(record.at("vertices").at(index.get<size_t>())));
            geometry.emplace_back(std::move(corners));
        }
        scene[record.at("name").get<std::string>()] = std::move(geometry);
    }
    return scene;
}

class Bridge {
public:
    // Returns the reply without its seq.
    json answer(const json& message) {
        const std::string cmd = message.at("cmd").get<std::string>();
        if (cmd == "start") return start(message);
        if (cmd == "run") return run(message);
        if (cmd == "scene") scenes_[message.at("id").get<std::string>()] = read_scene(message);
        else if (cmd != "stop") throw std::invalid_argument("unknown cmd " + cmd);
        return {{"result", json::object()}};
    }

private:
    static json start(const json& message) {
        if (message.at("version") != 1) throw std::invalid_argument("protocol version 1 is spoken here");
        return {{"result", introduction()}};
    }

    json run(const json& message) const {
        const std::string op = message.at("op").get<std::string>();
        const auto found = OPERATIONS.find(op);
        if (found == OPERATIONS.end()) return {{"skipped", {{"reason", "no operation " + op}}}};
        static const Scene nothing;
        const Scene& scene = message.contains("scene") ? scenes_.at(message.at("scene").get<std::string>()) : nothing;
        return {{"result", found->second(message.at("inputs"), scene)}};
    }

    std::map<std::string, Scene> scenes_;
};

}  // namespace

int main() {
    std::ios::sync_with_stdio(false);
    Bridge bridge;
    std::string line;
    while (std::getline(std::cin, line)) {
        json message, reply;
        try {
            message = json::parse(line);
            reply = bridge.answer(message);
        } catch (const std::exception& error) {
            reply = {{"errored", {{"context", error.what()}}}};
        }
        reply["seq"] = message.is_object() ? message.value("seq", json(nullptr)) : json(nullptr);
        std::cout << reply.dump() << '\n';
        std::cout.flush();  // the suite waits for each reply
        if (message.is_object() && message.value("cmd", "") == "stop") return 0;
    }
    return 0;
}
