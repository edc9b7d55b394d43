// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "sim/scene.h"

namespace throng::testing {

/// Expects every value of the two scenes to be the same, numbers bit for bit (no NaN gets this far).
inline void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.description, b.description);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.engine, b.engine);
  EXPECT_EQ(a.sleep, b.sleep);
  EXPECT_EQ(a.gravity, b.gravity);
  EXPECT_EQ(a.time.dt, b.time.dt);
  EXPECT_EQ(a.time.until, b.time.until);
  EXPECT_EQ(a.time.substeps, b.time.substeps);
  EXPECT_EQ(a.domain.kind, b.domain.kind);
  EXPECT_EQ(a.domain.min, b.domain.min);
  EXPECT_EQ(a.domain.max, b.domain.max);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.soft.stiffness, b.soft.stiffness);
  EXPECT_EQ(a.soft.tangential_stiffness, b.soft.tangential_stiffness);
  EXPECT_EQ(a.soft.youngs_modulus, b.soft.youngs_modulus);
  EXPECT_EQ(a.soft.poisson_ratio, b.soft.poisson_ratio);
  EXPECT_EQ(a.soft.tangential_damping, b.soft.tangential_damping);
  EXPECT_EQ(a.record.every, b.record.every);
  EXPECT_EQ(a.record.spin, b.record.spin);
  EXPECT_EQ(a.record.single, b.record.single);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_EQ(a.materials[i].name, b.materials[i].name);
    EXPECT_EQ(a.materials[i].density, b.materials[i].density);
    EXPECT_EQ(a.materials[i].restitution, b.materials[i].restitution);
    EXPECT_EQ(a.materials[i].friction, b.materials[i].friction);
    EXPECT_EQ(a.materials[i].rolling_resistance, b.materials[i].rolling_resistance);
  }
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (std::size_t i = 0; i < a.shapes.size(); ++i) {
    EXPECT_EQ(a.shapes[i].name, b.shapes[i].name);
    EXPECT_EQ(a.shapes[i].kind, b.shapes[i].kind);
    EXPECT_EQ(a.shapes[i].outline, b.shapes[i].outline);
    EXPECT_EQ(a.shapes[i].centre, b.shapes[i].centre);
    EXPECT_EQ(a.shapes[i].area, b.shapes[i].area);
    EXPECT_EQ(a.shapes[i].gyration2, b.shapes[i].gyration2);
    EXPECT_EQ(a.shapes[i].radius, b.shapes[i].radius);
    ASSERT_EQ(a.shapes[i].parts.size(), b.shapes[i].parts.size());
    for (std::size_t k = 0; k < a.shapes[i].parts.size(); ++k) {
      EXPECT_EQ(a.shapes[i].parts[k].vertices, b.shapes[i].parts[k].vertices);
      EXPECT_EQ(a.shapes[i].parts[k].radius, b.shapes[i].parts[k].radius);
    }
  }
  EXPECT_EQ(a.bodies.shape, b.bodies.shape);
  EXPECT_EQ(a.bodies.material, b.bodies.material);
  EXPECT_EQ(a.bodies.kind, b.bodies.kind);
  EXPECT_EQ(a.bodies.radius, b.bodies.radius);
  EXPECT_EQ(a.bodies.position, b.bodies.position);
  EXPECT_EQ(a.bodies.angle, b.bodies.angle);
  EXPECT_EQ(a.bodies.velocity, b.bodies.velocity);
  EXPECT_EQ(a.bodies.spin, b.bodies.spin);
  ASSERT_EQ(a.walls.size(), b.walls.size());
  for (std::size_t i = 0; i < a.walls.size(); ++i) {
    EXPECT_EQ(a.walls[i].points, b.walls[i].points);
    EXPECT_EQ(a.walls[i].closed, b.walls[i].closed);
    EXPECT_EQ(a.walls[i].material, b.walls[i].material);
  }
  EXPECT_EQ(a.crowd.walkable.rings, b.crowd.walkable.rings);
  EXPECT_EQ(a.crowd.group, b.crowd.group);
  EXPECT_EQ(a.crowd.desired_speed, b.crowd.desired_speed);
  ASSERT_EQ(a.crowd.queues.size(), b.crowd.queues.size());
  for (std::size_t i = 0; i < a.crowd.queues.size(); ++i) {
    EXPECT_EQ(a.crowd.queues[i].name, b.crowd.queues[i].name);
    EXPECT_EQ(a.crowd.queues[i].line, b.crowd.queues[i].line);
    EXPECT_EQ(a.crowd.queues[i].spacing, b.crowd.queues[i].spacing);
    EXPECT_EQ(a.crowd.queues[i].service, b.crowd.queues[i].service);
    EXPECT_EQ(a.crowd.queues[i].goal, b.crowd.queues[i].goal);
  }
  EXPECT_EQ(a.crowd.due, b.crowd.due);
  EXPECT_EQ(a.crowd.start, b.crowd.start);
  ASSERT_EQ(a.crowd.goals.size(), b.crowd.goals.size());
  for (std::size_t i = 0; i < a.crowd.goals.size(); ++i)
    EXPECT_EQ(a.crowd.goals[i].region.rings, b.crowd.goals[i].region.rings);
  ASSERT_EQ(a.crowd.areas.size(), b.crowd.areas.size());
  for (std::size_t i = 0; i < a.crowd.areas.size(); ++i) {
    EXPECT_EQ(a.crowd.areas[i].name, b.crowd.areas[i].name);
    EXPECT_EQ(a.crowd.areas[i].region.rings, b.crowd.areas[i].region.rings);
    EXPECT_EQ(a.crowd.areas[i].use, b.crowd.areas[i].use);
  }
  ASSERT_EQ(a.crowd.measures.size(), b.crowd.measures.size());
  for (std::size_t i = 0; i < a.crowd.measures.size(); ++i) {
    EXPECT_EQ(a.crowd.measures[i].name, b.crowd.measures[i].name);
    EXPECT_EQ(a.crowd.measures[i].line, b.crowd.measures[i].line);
    EXPECT_EQ(a.crowd.measures[i].area.rings, b.crowd.measures[i].area.rings);
    EXPECT_EQ(a.crowd.measures[i].size, b.crowd.measures[i].size);
    EXPECT_EQ(a.crowd.measures[i].cutoff, b.crowd.measures[i].cutoff);
    EXPECT_EQ(a.crowd.measures[i].after, b.crowd.measures[i].after);
    EXPECT_EQ(a.crowd.measures[i].last, b.crowd.measures[i].last);
  }
  ASSERT_EQ(a.crowd.groups.size(), b.crowd.groups.size());
  for (std::size_t i = 0; i < a.crowd.groups.size(); ++i) {
    EXPECT_EQ(a.crowd.groups[i].model, b.crowd.groups[i].model);
    EXPECT_EQ(a.crowd.groups[i].parameters, b.crowd.groups[i].parameters);
    EXPECT_EQ(a.crowd.groups[i].own, b.crowd.groups[i].own);
    EXPECT_EQ(a.crowd.groups[i].journey, b.crowd.groups[i].journey);
    EXPECT_EQ(a.crowd.groups[i].first, b.crowd.groups[i].first);
    EXPECT_EQ(a.crowd.groups[i].count, b.crowd.groups[i].count);
    ASSERT_EQ(a.crowd.groups[i].entrance.has_value(), b.crowd.groups[i].entrance.has_value());
    if (!a.crowd.groups[i].entrance) continue;
    EXPECT_EQ(a.crowd.groups[i].entrance->within.rings, b.crowd.groups[i].entrance->within.rings);
    EXPECT_EQ(a.crowd.groups[i].entrance->gap, b.crowd.groups[i].entrance->gap);
  }
}

}  // namespace throng::testing
