// SPDX-License-Identifier: MIT
#include "tools/bench/peers/chipmunk.h"

#include <chipmunk/chipmunk.h>

#include <cmath>
#include <numeric>

namespace throng::bench {

namespace {

constexpr double kSlop = 0.005;  // m; its default, 0.1, is meant for pixels

cpVect to_cp(const Vec& v) {
  return cpv(v.x(), v.y());
}

Vec from_cp(const cpVect& v) {
  return {v.x, v.y};
}

class ChipmunkSimulation : public Simulation {
 public:
  ChipmunkSimulation(const Scene& scene, int iterations)
      : scene_(scene), state_(initial_state(scene)), space_(cpSpaceNew()) {
    cpSpaceSetGravity(space_, to_cp(scene.gravity));
    cpSpaceSetCollisionSlop(space_, kSlop);
    cpSpaceSetIterations(space_, iterations);
    use_hash();
    for (std::size_t row = 0; row < scene.bodies.size(); ++row) bodies_.push_back(add_body(row));
    add_walls();
  }
  ChipmunkSimulation(const ChipmunkSimulation&) = delete;
  ChipmunkSimulation& operator=(const ChipmunkSimulation&) = delete;

  ~ChipmunkSimulation() override {
    for (cpShape* shape : shapes_) {
      cpSpaceRemoveShape(space_, shape);
      cpShapeFree(shape);
    }
    for (cpBody* body : bodies_) {
      cpSpaceRemoveBody(space_, body);
      cpBodyFree(body);
    }
    cpSpaceFree(space_);
  }

  void step() override {
    cpSpaceStep(space_, scene_.time.dt);
    ++state_.step;
    for (std::size_t row = 0; row < bodies_.size(); ++row) {
      state_.position[row] = from_cp(cpBodyGetPosition(bodies_[row]));
      state_.angle[row] = cpBodyGetAngle(bodies_[row]);
      state_.velocity[row] = from_cp(cpBodyGetVelocity(bodies_[row]));
      state_.spin[row] = cpBodyGetAngularVelocity(bodies_[row]);
    }
  }

  const State& state() const override { return state_; }
  bool restore(const State&) override { return false; }
  std::size_t contacts() const override {
    std::vector<ContactRow> rows;
    list_contacts(rows);
    return rows.size();
  }
  void list_contacts(std::vector<ContactRow>& rows) const override {
    rows.clear();
    for (std::size_t row = 0; row < bodies_.size(); ++row)
      if (scene_.bodies.kind[row] != BodyKind::fixed) cpBodyEachArbiter(bodies_[row], add_row, &rows);
  }
  std::span<const Sensed> sensed() const override { return {}; }
  std::vector<std::pair<std::string, double>> stage_times() const override { return {}; }

 private:
  /// Of all points of two shapes together; of two bodies that move from the first one alone.
  static void add_row(cpBody* body, cpArbiter* arbiter, void* rows) {
    cpBody *a, *b;
    cpArbiterGetBodies(arbiter, &a, &b);
    const std::uint32_t id = id_of(body), other = id_of(a == body ? b : a);
    if (other != 0 && other < id) return;
    const double impulse = cpvdot(cpArbiterTotalImpulse(arbiter), cpArbiterGetNormal(arbiter));
    static_cast<std::vector<ContactRow>*>(rows)->push_back(
        {id, other, std::abs(impulse), from_cp(cpArbiterGetPointA(arbiter, 0))});
  }

  /// 0 of what never moves.
  static std::uint32_t id_of(const cpBody* body) {
    if (cpBodyGetType(const_cast<cpBody*>(body)) == CP_BODY_TYPE_STATIC) return 0;
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(cpBodyGetUserData(body)));
  }

  void use_hash() {
    const std::vector<double>& radius = scene_.bodies.radius;
    const double sum = std::accumulate(radius.begin(), radius.end(), 0.0);
    if (sum > 0.0)
      cpSpaceUseSpatialHash(space_, 2.0 * sum / static_cast<double>(radius.size()),
                            static_cast<int>(10 * radius.size()));
  }

  cpBody* new_body(std::size_t row) const {
    switch (scene_.bodies.kind[row]) {
      case BodyKind::dynamic:
        return cpBodyNew(mass(scene_, row), inertia(scene_, row));
      case BodyKind::kinematic:
        return cpBodyNewKinematic();
      default:
        return cpBodyNewStatic();
    }
  }

  cpBody* add_body(std::size_t row) {
    const Bodies& bodies = scene_.bodies;
    cpBody* body = cpSpaceAddBody(space_, new_body(row));
    cpBodySetPosition(body, to_cp(bodies.position[row]));
    cpBodySetAngle(body, bodies.angle[row]);
    cpBodySetUserData(body, reinterpret_cast<cpDataPointer>(row + 1));
    if (bodies.kind[row] != BodyKind::fixed) {
      cpBodySetVelocity(body, to_cp(bodies.velocity[row]));
      cpBodySetAngularVelocity(body, bodies.spin[row]);
    }
    const Shape& shape = scene_.shapes[bodies.shape[row]];
    const Material& material = scene_.materials[bodies.material[row]];
    if (shape.kind == ShapeKind::disc) add(cpCircleShapeNew(body, bodies.radius[row], cpvzero), material);
    for (const narrowphase::Convex& part : shape.parts) add_part(body, part, material);
    return body;
  }

  void add_part(cpBody* body, const narrowphase::Convex& part, const Material& material) {
    std::vector<cpVect> points;
    for (const Vec& v : part.vertices) points.push_back(to_cp(v));
    if (points.size() == 1)
      add(cpCircleShapeNew(body, part.radius, points[0]), material);
    else if (points.size() == 2)
      add(cpSegmentShapeNew(body, points[0], points[1], part.radius), material);
    else
      add(cpPolyShapeNewRaw(body, static_cast<int>(points.size()), points.data(), part.radius), material);
  }

  void add_walls() {
    for (const Wall& wall : scene_.walls)
      for (std::size_t i = 0; i + (wall.closed ? 0 : 1) < wall.points.size(); ++i)
        add_edge(wall.points[i], wall.points[(i + 1) % wall.points.size()], scene_.materials[wall.material]);
    if (scene_.domain.kind != DomainKind::box) return;
    const Vec a = scene_.domain.min, c = scene_.domain.max, b(c.x(), a.y()), d(a.x(), c.y());
    const std::pair<Vec, Vec> sides[] = {{a, b}, {b, c}, {c, d}, {d, a}};
    for (const auto& [from, to] : sides) add_edge(from, to, scene_.materials[0]);
  }

  void add_edge(const Vec& from, const Vec& to, const Material& material) {
    add(cpSegmentShapeNew(cpSpaceGetStaticBody(space_), to_cp(from), to_cp(to), 0.0), material);
  }

  /// Chipmunk multiplies the two shapes' coefficients: two of one material get that material's.
  void add(cpShape* shape, const Material& material) {
    cpShapeSetFriction(shape, std::sqrt(material.friction));
    cpShapeSetElasticity(shape, std::sqrt(material.restitution));
    shapes_.push_back(cpSpaceAddShape(space_, shape));
  }

  const Scene& scene_;
  State state_;
  cpSpace* space_;
  std::vector<cpBody*> bodies_;
  std::vector<cpShape*> shapes_;
};

}  // namespace

std::unique_ptr<Simulation> chipmunk_simulation(const Scene& scene, int iterations) {
  if (scene.domain.kind == DomainKind::periodic) return nullptr;
  return std::make_unique<ChipmunkSimulation>(scene, iterations);
}

}  // namespace throng::bench
