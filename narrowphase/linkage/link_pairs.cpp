// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/link_pairs.h"

#include <algorithm>
#include <cmath>

namespace throng::narrowphase {

namespace {

/// kWorld counts as before all links.
bool comes_after(std::uint32_t link, std::uint32_t other) {
  return link != kWorld && (other == kWorld || link > other);
}

bool moves(const Link& link) {
  return link.lower < link.upper;
}

/// The joints between two links that move: those of one that does not hang on their common ancestor with it.
std::uint32_t moving_joints(std::span<const Link> linkage, LinkPair links) {
  const std::uint32_t ancestor = nearest_common_ancestor(linkage, links);
  std::uint32_t count = 0;
  for (std::uint32_t end : {links.a, links.b})
    for (; end != ancestor; end = linkage[end].parent) count += moves(linkage[end]);
  return count;
}

bool contains(std::span<const LinkPair> pairs, const LinkPair& pair) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const LinkPair& other) {
    return other == pair || LinkPair{other.b, other.a} == pair;
  });
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
  const auto consider = [&](const LinkPair& pair) {
    if (!contains(may_touch, pair)) pairs.push_back(pair);
  };
  for (std::uint32_t a = 0; with_obstacles && a < count; ++a)
    if (linkage[a].shape != nullptr) consider({a, kWorld});
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b)
      if (linkage[a].shape != nullptr && linkage[b].shape != nullptr && moving_joints(linkage, {a, b}) > 1 &&
          !limits_keep_apart(linkage, {a, b}, effort))
        consider({a, b});
  return pairs;
}

}  // namespace throng::narrowphase
