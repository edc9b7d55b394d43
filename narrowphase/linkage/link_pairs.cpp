// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/link_pairs.h"

#include <algorithm>
#include <tuple>

namespace throng::narrowphase {

namespace {

/// kWorld counts as before all links.
bool comes_after(std::uint32_t link, std::uint32_t other) {
  return link != kWorld && (other == kWorld || link > other);
}

bool moves(const Link& link) {
  return link.lower < link.upper;
}

/// Of one robot, and at most one joint moves of those that lead from one to the other.
bool share_a_joint(std::span<const Link> linkage, const LinkPair& links) {
  const std::uint32_t ancestor = nearest_common_ancestor(linkage, links);
  if (ancestor == kWorld) return false;
  int moving = 0;
  for (std::uint32_t end : {links.a, links.b})
    for (; end != ancestor; end = linkage[end].parent) moving += moves(linkage[end]);
  return moving <= 1;
}

bool comes_before(const LinkPair& x, const LinkPair& y) {
  return std::tie(x.a, x.b) < std::tie(y.a, y.b);
}

/// Ascending, and the lower one first in each; kWorld is the highest of all.
std::vector<LinkPair> sorted(std::span<const LinkPair> pairs) {
  std::vector<LinkPair> result;
  for (const auto& [a, b] : pairs) result.push_back({std::min(a, b), std::max(a, b)});
  std::sort(result.begin(), result.end(), comes_before);
  return result;
}

}  // namespace

std::uint32_t nearest_common_ancestor(std::span<const Link> linkage, LinkPair links) {
  while (links.a != links.b) {
    std::uint32_t& lower = comes_after(links.a, links.b) ? links.a : links.b;
    lower = linkage[lower].parent;
  }
  return links.a;
}

std::vector<LinkPair> pairs_to_check(std::span<const Link> linkage, bool with_obstacles,
                                     std::span<const LinkPair> may_touch, std::size_t effort) {
  std::vector<LinkPair> pairs;
  const auto count = static_cast<std::uint32_t>(linkage.size());
  const std::vector<LinkPair> left_out = sorted(may_touch);
  const auto is_asked = [&](const LinkPair& pair) {
    return !std::binary_search(left_out.begin(), left_out.end(), pair, comes_before);
  };
  const auto may_meet = [&](const LinkPair& pair) {
    return is_asked(pair) && !share_a_joint(linkage, pair) && !limits_keep_apart(linkage, pair, effort);
  };
  for (std::uint32_t a = 0; with_obstacles && a < count; ++a)
    if (linkage[a].shape != nullptr && is_asked({a, kWorld})) pairs.push_back({a, kWorld});
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b)
      if (linkage[a].shape != nullptr && linkage[b].shape != nullptr && may_meet({a, b}))
        pairs.push_back({a, b});
  return pairs;
}

}  // namespace throng::narrowphase
