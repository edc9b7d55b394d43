// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// The grammar of scenario files as a table: the one place that says which fields there are, what they may
/// hold, what they mean and what they are when absent. The check of a file and the JSON Schema for editors
/// both follow from it.
namespace throng::scenarios {

struct Table;

/// What a value may be.
struct Type {
  enum class Kind {
    boolean,
    integer,  ///< low to high
    number,   ///< low to high; an integer is fine
    text,     ///< up to `most` bytes
    choice,   ///< one of `choices`
    name,     ///< the name of an entry of the file's table `of`
    tuple,    ///< a list with exactly these `parts`
    list,     ///< `least` to `most` of parts[0]
    table,    ///< the fields of `table`
    tables,   ///< a list of `table`, written [[...]]
    named,    ///< a table of free names, each a parts[0]
    either    ///< any one of `parts`, which differ in kind
  } kind = Kind::boolean;
  double low = 0.0, high = 0.0;
  std::string unit;  ///< of a number, for messages
  std::vector<std::string> choices;
  std::string of;
  std::vector<Type> parts;
  std::size_t least = 0, most = 0;
  std::shared_ptr<const Table> table;
  std::string called;  ///< what a message calls it, such as "a point [x, y]"; else described by its kind
};

struct Field {
  std::string key;
  Type type;
  std::string doc;
  std::string preset = {};  ///< when absent, as TOML; "" where there is none
  bool required = false;
  bool later = false;  ///< known, and refused as not supported yet
};

struct Table {
  std::vector<Field> fields;
  std::vector<std::string> one_of = {};  ///< of these keys exactly one must stand there; none: no such rule
};

/// The table at the root of a scenario file. Built once.
const Table& grammar();

/// What the type allows, as a message says it: "a number from 0 to 1".
std::string describe(const Type& type);

}  // namespace throng::scenarios
