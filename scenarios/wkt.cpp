// SPDX-License-Identifier: MIT
#include "scenarios/wkt.h"

#include <charconv>
#include <cmath>

#include "scenarios/limits.h"
#include "scenarios/read.h"
#include "scenarios/report.h"

namespace throng::scenarios {

namespace {

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
bool is_letter(char c) {
  return upper(c) >= 'A' && upper(c) <= 'Z';
}
bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// "1st", "2nd", "12th".
std::string nth(std::size_t n) {
  const std::size_t last = n / 10 % 10 == 1 ? 0 : n % 10;
  return std::to_string(n) + (last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th");
}

class WktReader {
 public:
  WktReader(std::string_view text, WktKind kind) : text_(text), lines_too_(kind == WktKind::any) {}

  Wkt read() {
    const std::string type = word();
    if (type == "POLYGON") {
      list([this] { line(true); });
    } else if (type == "MULTIPOLYGON") {
      list([this] { list([this] { line(true); }); });
    } else if (lines_too_ && type == "LINESTRING") {
      line(false);
    } else if (lines_too_ && type == "LINEARRING") {
      line(true);
    } else if (lines_too_ && type == "MULTILINESTRING") {
      list([this] { line(false); });
    } else {
      fail_at_type(type);
    }
    skip_space();
    if (good() && at_ < text_.size()) fail("must end after its last parenthesis");
    return std::move(result_);
  }

 private:
  bool good() const { return result_.refusal.empty(); }

  void fail(const std::string& message) {
    if (good()) result_.refusal = message + " (character " + std::to_string(at_ + 1) + ")";
  }

  void fail_at_type(const std::string& type) {
    std::vector<std::string> known{"POLYGON", "MULTIPOLYGON"};
    if (lines_too_) known.insert(known.end(), {"LINESTRING", "LINEARRING", "MULTILINESTRING"});
    fail(std::string("must begin with ") +
         (lines_too_ ? "LINESTRING, LINEARRING, POLYGON, MULTILINESTRING or MULTIPOLYGON"
                     : "POLYGON or MULTIPOLYGON") +
         ", and begins with " + in_quotes(text_) + suggestion(type, known));
  }

  void skip_space() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }

  std::string word() {
    skip_space();
    std::size_t end = at_;
    std::string result;
    while (end < text_.size() && is_letter(text_[end]) && result.size() < 32) result += upper(text_[end++]);
    if (result.empty()) return result;
    at_ = end;
    return result;
  }

  bool take(char c) {
    skip_space();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  /// One or more of `item`, in parentheses, with commas between them.
  template <class Item>
  void list(Item item) {
    if (!take('(')) return fail("must have a ( here; Z, M and EMPTY are not supported");
    do item();
    while (good() && take(','));
    if (good() && !take(')')) fail("must have a , or ) here");
  }

  void line(bool ring) {
    WktLine line;
    list([&] {
      const double x = coordinate();
      const double y = coordinate();
      line.points.emplace_back(x, y);
    });
    if (!good()) return;
    const bool returns = line.points.size() >= 2 && line.points.front() == line.points.back();
    line.closed = returns && (ring || line.points.size() > 3);  // out and back is an open line
    if (line.closed) line.points.pop_back();
    if (ring && !line.closed)
      return fail("a ring must end with its first point: the " + nth(result_.lines.size() + 1) +
                  " begins at " + to_text(line.points.front()) + " and ends at " +
                  to_text(line.points.back()));
    if (line.points.size() < (ring ? 3 : 2) || (!line.closed && returns && line.points.size() == 2))
      return fail(ring ? "a ring must have at least 3 different points"
                       : "a line must have at least 2 different points");
    result_.lines.push_back(std::move(line));
  }

  double coordinate() {
    skip_space();
    if (!good()) return 0.0;
    double x = 0.0;
    const auto end = std::from_chars(text_.data() + at_, text_.data() + text_.size(), x);
    if (end.ec != std::errc() || !(std::abs(x) <= kFarthest)) {
      fail("must have a number from " + to_text(-kFarthest) + " to " + to_text(kFarthest) + " here");
      return 0.0;
    }
    at_ = static_cast<std::size_t>(end.ptr - text_.data());
    if (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != ',' && text_[at_] != ')')
      fail("must have a space, a , or a ) after a number");
    return x;
  }

  std::string_view text_;
  bool lines_too_;
  std::size_t at_ = 0;
  Wkt result_;
};

}  // namespace

Wkt read_wkt(std::string_view text, WktKind kind) {
  return WktReader(text, kind).read();
}

}  // namespace throng::scenarios
