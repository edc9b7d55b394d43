// SPDX-License-Identifier: MIT
#include "sim/engine_box2d.h"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/input_error.h"
#include "sim/meeting_materials.h"
#include "sim/sensing/sensing.h"
#include "sim/stage_clock.h"

namespace throng {

namespace {

using narrowphase::Convex;

b2Vec2 to_b2(const Vec& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

Vec from_b2(const b2Vec2& v) {
  return {v.x, v.y};
}

b2BodyType to_b2(BodyKind kind) {
  return kind == BodyKind::dynamic     ? b2_dynamicBody
         : kind == BodyKind::kinematic ? b2_kinematicBody
                                       : b2_staticBody;
}

void refuse_unsupported(const Scene& scene) {
  if (const std::string refusal = box2d_refusal(scene); !refusal.empty())
    throw InputError("engine box2d: " + refusal);
}

/// Calls visit(points) for each polygon that Box2D makes of the part: it has at most b2_maxPolygonVertices, a
/// larger one is cut into a fan.
template <class Visit>
void for_each_polygon(const Convex& part, Visit visit) {
  const auto n = static_cast<int>(part.vertices.size());
  for (int first = 1; first + 1 < n; first += b2_maxPolygonVertices - 2) {
    b2Vec2 points[b2_maxPolygonVertices];
    int count = 0;
    points[count++] = to_b2(part.vertices[0]);
    for (int i = first; i < n && count < b2_maxPolygonVertices; ++i)
      points[count++] = to_b2(part.vertices[static_cast<std::size_t>(i)]);
    visit(std::span<const b2Vec2>(points, static_cast<std::size_t>(count)));
  }
}

/// Box2D welds points nearer than half its slop, and asserts where fewer than three or hardly any area are
/// left.
bool is_thin(std::span<const b2Vec2> points) {
  float doubled_area = 0.0f;
  for (std::size_t i = 2; i < points.size(); ++i)
    doubled_area += b2Cross(points[i - 1] - points[0], points[i] - points[0]);
  if (doubled_area < 2.0f * b2_linearSlop * b2_linearSlop) return true;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (b2Distance(points[i], points[(i + 1) % points.size()]) < b2_linearSlop) return true;
  return false;
}

bool is_thin(const Shape& shape) {
  bool thin = false;
  for (const Convex& part : shape.parts)
    for_each_polygon(part, [&](std::span<const b2Vec2> points) { thin = thin || is_thin(points); });
  return thin;
}

class Box2dSimulation : public Simulation {
 public:
  explicit Box2dSimulation(const Scene& scene)
      : scene_(scene), state_(initial_state(scene)), world_(to_b2(scene.gravity)), sensing_(scene, 1) {
    refuse_unsupported(scene);
    world_.SetAllowSleeping(false);  // it would stop kinematic bodies that are slow
    for (std::size_t row = 0; row < scene.bodies.size(); ++row) bodies_.push_back(add_body(row));
    add_walls();
    sensing_.sense(state_);
  }

  void step() override {
    StageClock clock;
    const int n = scene_.time.substeps;
    world_.Step(static_cast<float>(scene_.time.dt), 2 * n, std::max(1, n - 1));
    clock.lap(solve_);
    ++state_.step;
    for (std::size_t row = 0; row < bodies_.size(); ++row) {
      const b2Body& body = *bodies_[row];
      state_.position[row] = from_b2(body.GetPosition());
      state_.angle[row] = body.GetAngle();
      state_.velocity[row] = from_b2(body.GetLinearVelocity());
      state_.spin[row] = body.GetAngularVelocity();
      check_body(state_, row);
      check_speed(row);
    }
    clock.lap(store_);
    if (scene_.sensors.empty()) return;
    sensing_.sense(state_);
    clock.lap(sense_);
  }

  const State& state() const override { return state_; }

  /// Its contacts' impulses, its trees and its islands' order are nobody's to set.
  bool restore(const State&) override { return false; }

  std::size_t contacts() const override {
    std::size_t count = 0;
    for_each_pressed([&](const b2Contact&, int) { ++count; });
    return count;
  }

  void list_contacts(std::vector<ContactRow>& rows) const override {
    rows.clear();
    for_each_pressed([&](const b2Contact& contact, int point) { rows.push_back(row_of(contact, point)); });
  }

  std::span<const Sensed> sensed() const override { return sensing_.sensed(); }

  std::vector<std::pair<std::string, double>> stage_times() const override {
    std::vector<std::pair<std::string, double>> all{{"box2d", solve_}, {"store", store_}};
    if (!scene_.sensors.empty()) all.push_back({"sense", sense_});
    return all;
  }

 private:
  /// The id of what moves; 0 of obstacles. Box2D's own way to it is not const.
  std::uint32_t id_of(const b2Body& body) const {
    if (body.GetType() == b2_staticBody) return 0;
    return static_cast<std::uint32_t>(const_cast<b2Body&>(body).GetUserData().pointer);
  }

  /// Does `work` with each contact and the points of its manifold at which the last step pushed.
  template <class Work>
  void for_each_pressed(Work work) const {
    for (const b2Contact* contact = world_.GetContactList(); contact; contact = contact->GetNext()) {
      const b2Manifold& manifold = *contact->GetManifold();
      for (int point = 0; contact->IsTouching() && point < manifold.pointCount; ++point)
        if (manifold.points[point].normalImpulse > 0.0f) work(*contact, point);
    }
  }

  ContactRow row_of(const b2Contact& contact, int point) const {
    std::uint32_t a = id_of(*contact.GetFixtureA()->GetBody()), b = id_of(*contact.GetFixtureB()->GetBody());
    if (a == 0 || (b != 0 && b < a)) std::swap(a, b);
    b2WorldManifold world;
    contact.GetWorldManifold(&world);
    return {a, b, contact.GetManifold()->points[point].normalImpulse, from_b2(world.points[point])};
  }

  /// Box2D silently slows down what is faster than its limits.
  void check_speed(std::size_t row) const {
    const double way = state_.velocity[row].norm() * scene_.time.dt;
    const double turn = std::abs(state_.spin[row]) * scene_.time.dt;
    if (way < 0.999 * b2_maxTranslation && turn < 0.999 * b2_maxRotation) return;
    throw SimulationError(
        "step " + std::to_string(state_.step) + ": body " + std::to_string(state_.id[row]) +
        " is faster than Box2D lets bodies be (2 m and a quarter turn a step): take a shorter dt");
  }

  b2Body* add_body(std::size_t row) {
    const Bodies& bodies = scene_.bodies;
    b2BodyDef definition;
    definition.type = to_b2(bodies.kind[row]);
    definition.position = to_b2(bodies.position[row]);
    definition.angle = static_cast<float>(bodies.angle[row]);
    definition.linearVelocity = to_b2(bodies.velocity[row]);
    definition.angularVelocity = static_cast<float>(bodies.spin[row]);
    definition.userData.pointer = row + 1;
    b2Body* body = world_.CreateBody(&definition);
    const Shape& shape = scene_.shapes[bodies.shape[row]];
    const Material& material = scene_.materials[bodies.material[row]];
    if (shape.kind == ShapeKind::disc) add_disc(*body, Vec(0.0, 0.0), bodies.radius[row], material);
    for (const Convex& part : shape.parts) add_part(*body, part, material);
    set_mass(*body, row);
    return body;
  }

  /// Box2D would count overlapping parts twice.
  void set_mass(b2Body& body, std::size_t row) {
    if (body.GetType() != b2_dynamicBody) return;
    b2MassData data;
    data.mass = static_cast<float>(mass(scene_, row));
    data.center.SetZero();
    data.I = static_cast<float>(inertia(scene_, row));
    body.SetMassData(&data);
  }

  static void add_fixture(b2Body& body, const b2Shape& shape, const Material& material) {
    b2FixtureDef definition;
    definition.shape = &shape;
    definition.density = static_cast<float>(material.density);
    definition.friction = static_cast<float>(material.friction);
    definition.restitution = static_cast<float>(material.restitution);
    definition.restitutionThreshold = 0.0f;
    body.CreateFixture(&definition);
  }

  static void add_disc(b2Body& body, const Vec& centre, double radius, const Material& material) {
    b2CircleShape disc;
    disc.m_p = to_b2(centre);
    disc.m_radius = static_cast<float>(radius);
    add_fixture(body, disc, material);
  }

  static void add_part(b2Body& body, const Convex& part, const Material& material) {
    if (part.vertices.size() == 1) return add_disc(body, part.vertices[0], part.radius, material);
    for_each_polygon(part, [&](std::span<const b2Vec2> points) {
      b2PolygonShape polygon;
      polygon.Set(points.data(), static_cast<int>(points.size()));
      add_fixture(body, polygon, material);
    });
  }

  void add_walls() {
    b2BodyDef definition;
    ground_ = world_.CreateBody(&definition);
    for (const Wall& wall : scene_.walls)
      for (std::size_t i = 0; i + (wall.closed ? 0 : 1) < wall.points.size(); ++i)
        add_edge(wall.points[i], wall.points[(i + 1) % wall.points.size()], scene_.materials[wall.material]);
    if (scene_.domain.kind != DomainKind::box) return;
    const Vec a = scene_.domain.min, c = scene_.domain.max, b(c.x(), a.y()), d(a.x(), c.y());
    add_edge(a, b, scene_.materials[0]);
    add_edge(b, c, scene_.materials[0]);
    add_edge(c, d, scene_.materials[0]);
    add_edge(d, a, scene_.materials[0]);
  }

  void add_edge(const Vec& from, const Vec& to, const Material& material) {
    b2EdgeShape edge;
    edge.SetTwoSided(to_b2(from), to_b2(to));
    add_fixture(*ground_, edge, material);
  }

  const Scene& scene_;
  State state_;
  b2World world_;
  b2Body* ground_ = nullptr;
  std::vector<b2Body*> bodies_;
  Sensing sensing_;
  double solve_ = 0.0, store_ = 0.0, sense_ = 0.0;  ///< s
};

}  // namespace

std::string box2d_refusal(const Scene& scene) {
  if (scene.crowd.size() > 0) return "agents: Box2D moves bodies alone";
  if (scene.domain.kind == DomainKind::periodic) return "domain.periodic: Box2D has no periodic domains";
  if (scene.contact == ContactModel::none) return "contact.model = \"none\": Box2D always handles contacts";
  if (is_soft(scene.contact))
    return "contact.model: Box2D's contacts are rigid; \"spring\" and \"hertz\" need native";
  if (const std::string rolls = rolling_refusal(scene, "Box2D 2.4.1 knows none"); !rolls.empty())
    return rolls;
  std::vector<bool> used(scene.shapes.size());
  for (std::uint32_t shape : scene.bodies.shape) used[shape] = true;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] && is_thin(scene.shapes[i]))
      return "shapes." + scene.shapes[i].name + ": is thinner, or has a shorter edge, than Box2D's 5 mm";
  return "";
}

std::unique_ptr<Simulation> box2d_simulation(const Scene& scene) {
  return std::make_unique<Box2dSimulation>(scene);
}

}  // namespace throng
