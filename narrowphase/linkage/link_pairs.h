// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/linkage/linkage.h"

namespace throng::narrowphase {

/// Two links, a before b; or a link and the obstacles, where b is kWorld.
struct LinkPair {
  std::uint32_t a, b;
  bool operator==(const LinkPair&) const = default;
};

/// The pairs of which a motion must be asked whether they meet: links against obstacles first, then links of
/// one robot and of several, each ascending. Left out are
///   - links without shape, and the pairs in `may_touch` (in either order; with kWorld: the obstacles);
///   - links of one robot that share a joint, at which they touch, those that rigid joints unite being one
///     body: at most one joint that moves lies between them, however far they reach. Of two robots none are:
///     an arm may well meet a post that is a robot of its own;
///   - links that the joint limits keep apart, where that is proven in `effort` distances: boxes of joint
///     values are halved until the distance at each centre exceeds what the joints between the two can move
///     them within the box. A revolute joint without limits goes once round, prismatic ones prove nothing.
/// Once a linkage: up to `effort` times some 300 ns a pair; allocates.
std::vector<LinkPair> pairs_to_check(std::span<const Link> linkage, bool with_obstacles,
                                     std::span<const LinkPair> may_touch = {}, std::size_t effort = 1000);

/// The last link, or kWorld, on which both hang, or which one of them is and the other hangs on. O(links).
std::uint32_t nearest_common_ancestor(std::span<const Link> linkage, LinkPair links);

/// Whether the joint limits keep two links apart for ever, as above. No proof is no contact.
bool limits_keep_apart(std::span<const Link> linkage, const LinkPair& links, std::size_t effort);

}  // namespace throng::narrowphase
