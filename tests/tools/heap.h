// SPDX-License-Identifier: MIT
#pragma once

namespace throng {

/// Discs and bricks that fall on one another, with friction and bounces: contacts of both kinds.
inline constexpr const char* kHeap = R"(throng = 1
name = "heap"
gravity = [0, -10]
time = { dt = 0.01, until = 2.0 }
domain = { box = [[-5, 0], [5, 9]] }
[materials]
default = { density = 1.0, friction = 0.5, restitution = 0.2 }
[shapes]
ball = { disc = { radius = 0.4 } }
brick = { polygon = [[0, 0], [1, 0], [1, 1], [0, 1]] }
[[bodies]]
shape = "ball"
place = { lattice = { origin = [-4, 1], spacing = [1.1, 1.1], size = [8, 3] } }
[[bodies]]
shape = "brick"
place = { lattice = { origin = [-4, 5], spacing = [1.2, 1.2], size = [7, 2] } }
)";

}  // namespace throng
