// SPDX-License-Identifier: MIT
#pragma once

#include "scenarios/grammar.h"
#include "scenarios/limits.h"

/// The words that grammars are written in: a maker for each kind of value, and the lengths and points that
/// all of them share.
namespace throng::scenarios::types {

Type boolean();
Type number(double low, double high, std::string unit = "");
Type integer(double low, double high);
Type text(std::size_t most = 65536, std::string called = "");
Type choice(std::vector<std::string> choices);
Type name_in(std::string of);  ///< an entry of the file's table `of`
Type tuple(std::vector<Type> parts, std::string called);
Type list(Type part, std::size_t least, std::string called, std::size_t most = kMostItems);
Type either(std::vector<Type> parts);
Type table(Table fields);
Type tables(Table fields);
Type named(Type part);
Type version();

Field required(Field field);
Field later(std::string key, std::string doc);  ///< that the grammar knows and this version refuses

Type coordinate();  ///< m
Type length();      ///< m, above 0
Type angle();       ///< rad
Type point();
Type points(std::size_t least, std::string called, std::size_t most = kMostItems);
Type box();

// What scenarios and motions both have.
Field polygon_field();
Field discs_field();
Field holes_field();
Table wall_lines();  ///< the ways to give a wall

}  // namespace throng::scenarios::types
