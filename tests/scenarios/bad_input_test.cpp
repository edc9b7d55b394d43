// SPDX-License-Identifier: MIT
// One fault a scenario: each must be found at its place and named.
#include <gtest/gtest.h>

#include "tests/scenarios/scenario_texts.h"

namespace throng {

using testing::faults;
using testing::load_text;

namespace {

struct FaultyScenario {
  const char* text;  ///< after a first line "throng = 1"
  const char* fault;
};

/// What precedes a body or a shape that is about something else.
#define BALL "[shapes]\nb.disc.radius = 1\n[[bodies]]\nshape = \"b\"\n"
#define SHAPE "[shapes]\nb = "
#define WALL "[[walls]]\n"

const FaultyScenario kFaultyScenarios[] = {
    // text
    {"name = \"a", "s.toml:2:10: error: this is no TOML: "},
    {"name = 'a'\nname = 'b'", "s.toml:3:8: error: this is no TOML: "},
    {"name = \"\xff\xfe\"", "s.toml:2:8: error: this is no TOML: "},
    {"time = { dt = 1e999 }", "s.toml:2:"},
    {"time = { dt = 1, dt = 2 }", "s.toml:2:23: error: this is no TOML: "},
    {"[time\ndt = 1", "s.toml:2:6: error: this is no TOML: "},
    {"seed = 99999999999999999999", "s.toml:2:"},
    {"<scenario/>", "s.toml:2:1: error: this is no TOML: "},
    {"[a]\n[a]", "error: this is no TOML: "},
    {"name = abc",
     "s.toml:2:8: error: this is no TOML: a value is a text in quotes, as in \"abc\", a number, as "
     "in 0.5 or 1e-3, true, false, a list [a, b] or a table { key = a }\n"},
    {"contact = { model = none }",
     "error: this is no TOML: a value is a text in quotes, as in \"none\", a number"},
    {"engine = native", "this is no TOML: a value is a text in quotes, as in \"native\", a number"},
    {"seed = 1\nname = t", "s.toml:3:9: error: this is no TOML: a value is a text in quotes, as in \"t\", a"},
    {"sleep = True",
     "s.toml:2:9: error: this is no TOML: \"True\" is no value: say true or false, or \"True\" in quotes, a "
     "text\n"},
    {"sleep = no",
     "s.toml:2:10: error: this is no TOML: \"no\" is no value: say true or false, or \"no\" in quotes, a "
     "text\n"},
    {"sleep = OFF # now",
     "error: this is no TOML: \"OFF\" is no value: say true or false, or \"OFF\" in quotes, a text\n"},
    {"sleep = nope", "this is no TOML: a value is a text in quotes, as in \"nope\", a number"},
    {"x = 'é' # é\na = [1, \"é\", straße]",
     "s.toml:3:14: error: this is no TOML: a value is a text in quotes, as in \"straße\", a"},
    {"name = (1, 2)",
     "s.toml:2:8: error: this is no TOML: a value is a text in quotes, as in \"pile\", a number"},
    {"seed = -\nname = 'a'",
     "s.toml:2:8: error: this is no TOML: a value is a text in quotes, as in \"pile\", a number"},
    {"time.dt = 0.5m", "s.toml:2:14: error: this is no TOML: Error while parsing floating-point: expected "},
    // keys
    {"nmae = 'a'", "s.toml:2:1: error: nmae: unknown key, did you mean \"name\"?"},
    {"time = { dt = 1, untill = 2 }",
     "s.toml:2:18: error: time.untill: unknown key, did you mean \"until\"?"},
    {"qqqqqqqqqq = 1", "s.toml:2:1: error: qqqqqqqqqq: unknown key, must be one of \"throng\", \"name\", "},
    {"\"a b\" = 1", "s.toml:2:1: error: \"a b\": unknown key"},
    {"[materials.ice]\nfricton = 1",
     "s.toml:3:1: error: materials.ice.fricton: unknown key, did you mean \"friction\"?"},
    {SHAPE "{ disk = { radius = 1 } }",
     "s.toml:3:7: error: shapes.b.disk: unknown key, did you mean \"disc\"?"},
    {BALL "at = [0, 0]\nvelocty = [0, 0]", "s.toml:7:1: error: bodies[0].velocty: unknown key, did you mean"},
    {WALL "segmnt = [[0, 0], [1, 0]]",
     "s.toml:3:1: error: walls[0].segmnt: unknown key, did you mean \"segment\"?"},
    {"domain.sphere = 1", "s.toml:2:8: error: domain.sphere: unknown key"},
    // not supported yet
    {"[[sensors]]\nradius = 1", "s.toml:2:1: error: sensors[0].name: is missing"},
    {"[[sensors]]\nname = \"a\"\nradius = 1\nsight = 3",
     "s.toml:5:9: error: sensors[0].sight: must be true or false, or one of"},
    {"[[measure]]\nname = 'x'\nline = [[0, 0], [1, 0]]",
     "error: measure: counts agents, and there are none: it needs [[agents]]"},
    // soft contacts
    {"contact = { model = 'spring' }",
     "s.toml:2:11: error: contact.stiffness: is missing: contact.model \"spring\" needs it"},
    {"contact = { model = 'hertz' }",
     "s.toml:2:11: error: contact.youngs_modulus: is missing: contact.model \"hertz\" needs it"},
    {"contact = { stiffness = 1e5 }",
     "s.toml:2:25: error: contact.stiffness: belongs to contact.model \"spring\", and it is \"impulse\""},
    {"contact = { model = 'hertz', youngs_modulus = 1e6, tangential_stiffness = 0.5 }",
     "s.toml:2:75: error: contact.tangential_stiffness: belongs to contact.model \"spring\", and it is "
     "\"hertz\""},
    {"contact = { model = 'none', tangential_damping = 0.5 }",
     "contact.tangential_damping: belongs to contact.model \"spring\" or \"hertz\", and it is \"none\""},
    {"contact = { model = 'spring', stiffness = 0 }",
     "s.toml:2:43: error: contact.stiffness: must be a number from 1e-09 to 1e+15 N/m"},
    {"contact = { model = 'hertz', youngs_modulus = 1e6, poisson_ratio = 0.6 }",
     "contact.poisson_ratio: must be a number from 0 to 0.5"},
    {"contact = { model = 'spring', stiffness = 1e5 }\nshapes.b.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n"
     "[[bodies]]\nshape = 'b'\nat = [1, 1]",
     "s.toml:2:21: error: contact.model: \"spring\" is of discs, and body 1 is a dynamic \"b\", which is "
     "none"},
    {"engine = 'box2d'\ncontact = { model = 'spring', stiffness = 1e5 }\n" BALL "at = [0, 0]",
     "s.toml:2:10: error: engine: box2d: contact.model: "},
    {"engine = 'event_driven'\ncontact = { model = 'hertz', youngs_modulus = 1e5 }\n" BALL "at = [0, 0]",
     "s.toml:2:10: error: engine: event_driven: contact.model: "},
    {"time = { dt = 0.01, substeps = 4 }\ncontact = { model = 'spring', stiffness = 1e6 }\n" BALL
     "at = [0, 0]",
     "s.toml:2:32: error: time.substeps: an impact lasts 0.00557 s, 2.23 substeps of 0.0025 s: unstable in a "
     "dense packing; time.substeps must be at least 34"},
    {"time = { dt = 0.1, substeps = 4 }\ncontact = { model = 'spring', stiffness = 1e10 }\n" BALL
     "at = [0, 0]",
     "unstable in a dense packing; time.dt must be at most "},
    {"time = { dt = 0.01, substeps = 8 }\ncontact = { model = 'spring', stiffness = 1e5 }\n" BALL
     "at = [0, 0]\nvelocity = [900, 0]\n" WALL "segment = [[3, -1], [3, 1]]",
     "s.toml:2:32: error: time.substeps: the fastest body moves at 900 m/s, so 1.12 m in a substep, farther "
     "than the smallest disc's radius, 1 m, and passes others unseen; time.substeps must be at least 9 (or "
     "time.dt at most 0.0088 s, with time.substeps = 8)"},
    {"record = { quantize = 0 }",
     "s.toml:2:23: error: record.quantize: must be a number from 1e-09 to 1000 m"},
    {"record = { fields = ['angle'], quantize = 1e-3 }",
     "s.toml:2:43: error: record.quantize: rounds positions, which are not in fields"},
    {"domain = { box = [[0, 0], [20, 60]] }\nrecord = { quantize = 1e-9 }",
     "s.toml:3:23: error: record.quantize: is too fine where positions go up to 60 m from 0: must be at "
     "least "
     "2.8e-08 m"},
    {"domain = { periodic = [[-70, 0], [20, 60]] }\nrecord = { quantize = 1e-8, within = [[-30, 0], [9, 9]] "
     "}",
     "s.toml:3:23: error: record.quantize: is too fine where positions go up to 30 m from 0: must be at "
     "least "
     "1.4e-08 m"},
    {"record = { quantize = 1e-8, within = [[-30, 0], [9, 9]] }",
     "go up to 30 m from 0: must be at least 1.4e-08 m"},
    {BALL "at = [0, -5]\n[record]\nquantize = 1e-9", "go up to 5 m from 0: must be at least 2.4e-09 m"},
    {"record = { also = [{ every = 5, fields = [] }] }",
     "s.toml:2:42: error: record.also[0].fields: must be a list of fields, one or more, and is an empty "
     "list"},
    {"record = { within = [[0, 0], [0, 1]] }",
     "s.toml:2:21: error: record.within: must have its least x and y first, [[min x, min y], [max x, max "
     "y]], "
     "and is [[0, 0], [0, 1]]"},
    {"record = { fields = ['position', 'angle', 'position'] }",
     "s.toml:2:43: error: record.fields: \"position\" stands there twice"},
    {"record = { also = [{ every = 5, fields = ['velocity'] }] }",
     "s.toml:2:43: error: record.also[0].fields: \"velocity\" is recorded already, each 1 steps"},
    {"record = { fields = [], also = [{ every = 5, fields = ['spin', 'spin'] }] }",
     "record.also[0].fields: \"spin\" is recorded already, each 5 steps"},
    {"record = { also = [{ fields = ['spin'] }] }", "s.toml:2:20: error: record.also[0].every: is missing"},
    {BALL "at = [0, 0]\n[record]\nof.ids = [1, 2]", "record.of.ids: there is no body 2; ids go from 1 to 1"},
    {BALL "at = [0, 0]\n[record]\nof = { kind = 'static' }", "record.of: fits no body"},
    {BALL "at = [0, 0]\n[record]\nof = { group = 'guests' }",
     "record.of.group: no [[agents]] are called \"guests\": none have a name"},
    {BALL "at = [0, 0]\n[record]\nof = { shape = ['b', 'c'] }",
     "record.of.shape[1]: there is no \"c\" in [shapes], did you mean \"b\"?"},
    {BALL "place = { file = 'a.csv' }",
     "s.toml:6:11: error: bodies[0].place.file: not supported yet: bodies[0].place"},
    // choices and names
    {"engine = 'navite'",
     "s.toml:2:10: error: engine: must be one of \"native\", \"box2d\", \"event_driven\", and is \"navite\", "
     "did you mean"},
    {"contact.model = 'impulses'",
     "s.toml:2:17: error: contact.model: must be one of \"impulse\", \"spring\", \"hertz\", \"none\", and "
     "is"},
    {"time = { dt = '1ms' }",
     "s.toml:2:15: error: time.dt: must be a number from 1e-12 to 1e+06 s, or \"auto\", and is \"1ms\"\n"},
    {"time = { dt = 'auto', error = 0.01, substeps = 4 }",
     "s.toml:2:48: error: time.substeps: is chosen, as dt is \"auto\": leave it out; on a command line, "
     "replace "
     "all of time, as in --set 'time={dt="},
    {"record.fields = ['positon']", "s.toml:2:18: error: record.fields[0]: must be one of"},
    {"record.precision = 'half'",
     "s.toml:2:20: error: record.precision: must be one of \"double\", \"single\""},
    {BALL "at = [0, 0]\nkind = 'fixed'",
     "s.toml:7:8: error: bodies[0].kind: must be one of \"dynamic\", \"static\""},
    {"[shapes]\nball.disc.radius = 1\n[[bodies]]\nshape = 'bal'\nat = [0, 0]",
     "s.toml:5:9: error: bodies[0].shape: there is no \"bal\" in [shapes], did you mean \"ball\"?"},
    {"[[bodies]]\nshape = 'a'\nat = [0, 0]",
     "s.toml:3:9: error: bodies[0].shape: there is no \"a\" in [shapes], which is empty"},
    {BALL "at = [0, 0]\n[[bodies]]\nshape = 'wheelbarrow'\nat = [5, 0]",
     "bodies[1].shape: there is no \"wheelbarrow\" in [shapes], must be one of \"b\""},
    {BALL "at = [0, 0]\nmaterial = 'ice'",
     "s.toml:7:12: error: bodies[0].material: there is no \"ice\" in [materials]"},
    {WALL "segment = [[0, 0], [1, 0]]\nmaterial = 'x'",
     "s.toml:4:12: error: walls[0].material: there is no \"x\""},
    // types
    {"name = \"a\\u0000b\"", "s.toml:2:8: error: name: holds U+0000"},
    {"[materials.\"a\\u0000b\"]\nfriction = 1", "has U+0000 in its name"},
    {"name = 1", "s.toml:2:8: error: name: must be a string of at most 256 bytes, and is the integer 1"},
    {"seed = 1.0",
     "s.toml:2:8: error: seed: must be an integer from 0 to 9007199254740991, and is the number 1"},
    {"seed = '1'", "s.toml:2:8: error: seed: must be an integer"},
    {"sleep = 1", "s.toml:2:9: error: sleep: must be true or false, and is the integer 1"},
    {"gravity = 9.81", "s.toml:2:11: error: gravity: must be an acceleration [x, y], and is the number 9.81"},
    {"gravity = [0]", "s.toml:2:11: error: gravity: must be an acceleration [x, y], and is a list of 1"},
    {"gravity = [0, 0, 0]",
     "s.toml:2:11: error: gravity: must be an acceleration [x, y], and is a list of 3"},
    {"gravity = [0, 'down']", "s.toml:2:15: error: gravity[1]: must be a number"},
    {"time = 1",
     "s.toml:2:8: error: time: must be a table { dt, error, until, substeps }, and is the integer 1"},
    {"time.substeps = 2.5", "s.toml:2:17: error: time.substeps: must be an integer from 1 to 1000"},
    {"domain = 1979-05-27",
     "s.toml:2:10: error: domain: must be a table { box, periodic }, and is a date or time"},
    {"shapes = []", "s.toml:2:10: error: shapes: must be a table of names, and is an empty list"},
    {"bodies = {}", "s.toml:2:10: error: bodies: must be a list of tables [[...]], and is a table"},
    {"bodies = [1]", "s.toml:2:11: error: bodies[0]: must be a table"},
    {SHAPE "1",
     "s.toml:3:5: error: shapes.b: must be a table { disc, polygon, discs, holes }, and is the integer 1"},
    {SHAPE "{ disc = { radius = [1] } }", "s.toml:3:25: error: shapes.b.disc.radius: must be a number"},
    {SHAPE "{ polygon = [[0, 0], [1, 0]] }",
     "s.toml:3:17: error: shapes.b.polygon: must be a list of 3 to 10000 points"},
    {SHAPE "{ polygon = [[0,0],[9,0],[0,9]], holes = [[[1,1],[2,1]]] }",
     "s.toml:3:47: error: shapes.b.holes[0]: must be a list of 3 to 10000 points"},
    {SHAPE "{ polygon = [[0,0],[9,0],[0,9]], holes = 1 }",
     "error: shapes.b.holes: must be a list of at most 1000 holes"},
    {SHAPE "{ disc = { radius = 1 }, holes = [] }", "s.toml:3:38: error: shapes.b.holes: only a polygon has"},
    {SHAPE "{ discs = [] }",
     "s.toml:3:15: error: shapes.b.discs: must be a list of 1 to 1000 discs [x, y, radius]"},
    {SHAPE "{ discs = [[0, 0]] }", "s.toml:3:16: error: shapes.b.discs[0]: must be a disc [x, y, radius]"},
    {WALL "wkt = 1", "s.toml:3:7: error: walls[0].wkt: must be a well-known text"},
    {WALL "segment = [[0, 0]]", "s.toml:3:11: error: walls[0].segment: must be two points"},
    {WALL "polyline = [[0, 0]]",
     "s.toml:3:12: error: walls[0].polyline: must be a list of at least 2 points"},
    {BALL "at = [0, 0]\nangle = '1'", "s.toml:7:9: error: bodies[0].angle: must be a number"},
    {BALL "at = [0, 0]\nvelocity = 1",
     "s.toml:7:12: error: bodies[0].velocity: must be a velocity [vx, vy], or a table"},
    // ranges
    {"time.dt = 0",
     "s.toml:2:11: error: time.dt: must be a number from 1e-12 to 1e+06 s, and is the integer 0"},
    {"time.dt = -0.1", "s.toml:2:11: error: time.dt: must be a number"},
    {"time.dt = nan",
     "s.toml:2:11: error: time.dt: must be a number from 1e-12 to 1e+06 s, and is the number nan"},
    {"time.until = inf", "s.toml:2:14: error: time.until: must be a number"},
    {"time = { dt = 1e-12, until = 1e12 }",
     "s.toml:2:30: error: time.until: until / dt is 1e+24 steps; must be at most"},
    {"time.substeps = 0",
     "s.toml:2:17: error: time.substeps: must be an integer from 1 to 1000, and is the integer 0"},
    {"gravity = [0, 1e308]", "s.toml:2:15: error: gravity[1]: must be a number"},
    {"seed = -1",
     "s.toml:2:8: error: seed: must be an integer from 0 to 9007199254740991, and is the integer -1"},
    {"record.every = 0", "s.toml:2:16: error: record.every: must be an integer from 1"},
    {"domain.box = [[0, 0], [0, 1]]",
     "s.toml:2:14: error: domain.box: must have its least x and y first, [[min x, min y], [max x, max y]], "
     "and is [[0, 0], [0, 1]]"},
    {"domain.periodic = [[5, 5], [0, 0]]",
     "s.toml:2:19: error: domain.periodic: must have its least x and y first"},
    {"domain = {}", "s.toml:2:10: error: domain: needs exactly one of box, periodic, and has none"},
    {"domain = { box = [[0,0],[1,1]], periodic = [[0,0],[1,1]] }", "has box, periodic"},
    {"materials.a.density = 0", "s.toml:2:23: error: materials.a.density: must be a number"},
    {"materials.a.restitution = 1.01",
     "s.toml:2:27: error: materials.a.restitution: must be a number from 0 to 1, and"},
    {"materials.a.friction = -0.1", "s.toml:2:24: error: materials.a.friction: must be a number from 0"},
    {SHAPE "{ disc = { radius = 0 } }",
     "s.toml:3:25: error: shapes.b.disc.radius: must be a number from 1e-09"},
    {SHAPE "{ disc = { radius = -1 } }",
     "s.toml:3:25: error: shapes.b.disc.radius: must be a number from 1e-09"},
    {SHAPE "{ disc.radius.uniform = [0, 1] }",
     "s.toml:3:30: error: shapes.b.disc.radius.uniform[0]: must be a number"},
    {SHAPE "{ disc.radius.uniform = [2, 1] }",
     "s.toml:3:29: error: shapes.b.disc.radius.uniform: must have its lower"},
    {SHAPE "{ discs = [[0, 0, 1], [0, 0, 0]] }",
     "s.toml:3:34: error: shapes.b.discs[1][2]: must be a number"},
    {BALL "at = [1e10, 0]",
     "s.toml:6:7: error: bodies[0].at[0]: must be a number from -1e+09 to 1e+09 m, and is"},
    {BALL "at = [0, 0]\nspin = inf", "s.toml:7:8: error: bodies[0].spin: must be a number"},
    {BALL "at = [0, 0]\nvelocity = { maxwell = -1 }",
     "s.toml:7:24: error: bodies[0].velocity.maxwell: must be"},
    {BALL "at = [0, 0]\nangle.uniform = [1, 0]",
     "error: bodies[0].angle: must have its lower bound first, and is [1, 0]"},
    {BALL "count = -1\nat = [0, 0]",
     "s.toml:6:9: error: bodies[0].count: must be an integer from 0 to 10000000"},
    {BALL "count = 10000001\nat = [0, 0]",
     "s.toml:6:9: error: bodies[0].count: must be an integer from 0 to 10000000"},
    // what must be there
    {SHAPE "{}", "s.toml:3:5: error: shapes.b: needs exactly one of disc, polygon, discs, and has none"},
    {SHAPE "{ disc = {} }", "s.toml:3:14: error: shapes.b.disc.radius: is missing: a number"},
    {"[[bodies]]\nat = [0, 0]",
     "s.toml:2:1: error: bodies[0].shape: is missing: the name of an entry of [shapes]"},
    {BALL "", "s.toml:4:1: error: bodies[0]: needs exactly one of at, place, and has none"},
    {BALL "at = [0, 0]\nplace = { lattice = { origin = [0, 0], spacing = [1, 1], size = [1, 1] } }",
     "has at, place"},
    {BALL "place = { random = {} }", "s.toml:6:20: error: bodies[0].place.random.within: is missing: a box"},
    {BALL "place = { lattice = { spacing = [1, 1], size = [1, 1] } }",
     "place.lattice.origin: is missing: a point"},
    {BALL "place = { random = { within = 'start' } }",
     "bodies[0].place.random.within: must be a box [[min x, min y]"},
    {WALL "",
     "s.toml:2:1: error: walls[0]: needs exactly one of segment, polyline, polygon, wkt, and has none"},
    // what only the whole tells
    {BALL "count = 2\nat = [0, 0]",
     "s.toml:6:9: error: bodies[0].count: must be 1 for bodies placed by at, and is 2; "},
    {BALL "count = 5\nplace.lattice = { origin = [0, 0], spacing = [3, 3], size = [2, 2] }",
     "s.toml:6:9: error: bodies[0].count: must be at most the 4 sites of the lattice, and is 5"},
    {BALL "place.lattice = { origin = [0, 0], spacing = [3, 3], size = [10000, 10000] }",
     "must make at most 10000000"},
    {BALL "place.lattice = { origin = [0, 0], spacing = [1e9, 3], size = [9, 1] }",
     "must end within 1e+09 m of the"},
    {BALL "at = [0, 0]\nkind = 'static'\nspin = 1",
     "s.toml:8:8: error: bodies[0].spin: must be absent for a static"},
    {BALL "at = [0, 0]\nkind = 'static'\nvelocity = [1, 0]",
     "bodies[0].velocity: must be absent for a static body"},
    {BALL "place.random = { within = [[0, 0], [1, 1]] }", "body 1 is too large for `within`: 2 m across"},
    {BALL "place.random = { within = [[3, 0], [0, 3]] }",
     "bodies[0].place.random.within: must have its least x and y"},
    {BALL "count = 9\nplace.random = { within = [[0, 0], [5, 5]] }", "bodies[0].place.random: body "},
    {"domain.box = [[0, 0], [9, 9]]\n" BALL "at = [20, 5]",
     "bodies[0].at: 1 body is not inside domain.box; the first is"},
    {"domain.box = [[0, 0], [9, 9]]\n" BALL "at = [0.5, 5]", "bodies[0].at: 1 body is not inside domain.box"},
    {"domain.box = [[0, 0], [9, 9]]\n" BALL "place.random = { within = [[0, 0], [10, 9]] }",
     "must lie inside domain.box"},
    {"domain.periodic = [[0, 0], [9, 1.5]]\n" BALL "at = [5, 0]",
     "bodies[0].shape: a body 2 m across needs domain.periodic to be at least 5 m wide and high, and it is "
     "1.5 m"},
    {"domain.periodic = [[0, 0], [1, 1]]\nshapes.b.disc.radius = 0.4\n[[bodies]]\nshape = 'b'\nat = [0, 0]",
     "bodies[0].shape: a body 0.8 m across needs domain.periodic to be at least 2 m wide and high, and it is "
     "1 m"},
    {"domain.periodic = [[0, 0], [9, 9]]\n" BALL
     "count = 2\nplace.lattice = { origin = [2, 2], spacing = [4, 4], "
     "size = [2, 1] }\nvelocity = [0, 200]",
     "domain.periodic: step 1: body 1 may reach 3.1 m within its 0.01 s, farther than a quarter of the "
     "period, "
     "2.25 m: take time.dt at most 0.00542 s, or a wider domain"},
    {"domain.periodic = [[0, 0], [9, 9]]\n" BALL "place.random = { within = [[0, 0], [9, 9]], gap = 8 }",
     "bodies[0].shape: a body 2 m across with its gap of 8 m needs domain.periodic to be at least 10 m wide"},
    // lengths whose squares vanish: they gave normals of nan
    {WALL "segment = [[0, 0], [1e-200, 0]]",
     "s.toml:3:11: error: walls[0].segment: has points 1e-200 m apart; must be equal or at least 1e-12 m "
     "apart"},
    {WALL "polygon = [[0, 0], [1, 0], [1, 1e-13]]",
     "s.toml:3:11: error: walls[0].polygon: has points 1e-13 m apart"},
    {WALL "wkt = 'LINESTRING (0 0, 1 0, 1 1e-150)'",
     "s.toml:3:7: error: walls[0].wkt: has points 1e-150 m apart"},
    {SHAPE "{ polygon = [[0, 0], [1, 0], [1, 1e-200], [0, 1]] }",
     "s.toml:3:17: error: shapes.b.polygon: has points 1e-200 m apart"},
    {"domain.box = [[0, 0], [1e-200, 1]]",
     "s.toml:2:14: error: domain.box: must be at least 1e-12 m wide and high"},
    // what an engine can't do
    {"engine = 'box2d'\ndomain.periodic = [[0, 0], [9, 9]]\n" BALL "at = [1, 1]",
     "s.toml:2:10: error: engine: box2d: domain.periodic: Box2D has no periodic domains"},
    {"engine = 'event_driven'\ncontact.model = 'none'",
     "s.toml:2:10: error: engine: event_driven: contact.model = \"none\": "},
    {"engine = 'event_driven'\nshapes.b.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[[bodies]]\nshape = "
     "'b'\nat = [1, 1]",
     "s.toml:2:10: error: engine: event_driven: shapes.b: body 1 isn't a disc"},
    {"engine = 'box2d'\ncontact.model = 'none'",
     "s.toml:2:10: error: engine: box2d: contact.model = \"none\": "},
    {"engine = 'box2d'\nshapes.b.polygon = [[0, 0], [0.004, 0], [0.004, 1], [0, 1]]\n[[bodies]]\nshape = "
     "'b'\nat = [0, 0]",
     "s.toml:2:10: error: engine: box2d: shapes.b: is thinner, or has a shorter edge, than Box2D's 5 mm"},
    {WALL "polygon = [[0, 0], [1, 0], [0, 0]]",
     "s.toml:3:11: error: walls[0].polygon: must have at least 3 different"},
    {WALL "segment = [[1, 2], [1, 2]]",
     "s.toml:3:11: error: walls[0].segment: must have at least 2 different points"},
    {WALL "wkt = 'CIRCLE (0 0)'", "s.toml:3:7: error: walls[0].wkt: must begin with LINESTRING"},
    {WALL "wkt = 'LINESTRING (0 0, 1)'", "s.toml:3:7: error: walls[0].wkt: must have a number"},
    {WALL "wkt = 'LINESTRING (0 0, 1 nan)'", "error: walls[0].wkt: must have a number"},
    {WALL "wkt = 'LINESTRING (0 0, 1 1'", "error: walls[0].wkt: must have a , or ) here (character 21)"},
    {WALL "wkt = 'LINESTRING (0 0, 1 1) x'", "error: walls[0].wkt: must end after its last parenthesis"},
    {WALL "wkt = 'POLYGON ((0 0, 1 0, 1 1))'",
     "error: walls[0].wkt: a ring must end with its first point: "
     "the 1st begins at [0, 0] and ends at [1, 1] (character 25)"},
    {WALL "wkt = 'POLYGON ((0 0, 1 0, 0 0))'",
     "error: walls[0].wkt: a ring must have at least 3 different points"},
    {WALL "wkt = 'LINESTRING (0 0, 1.5.5)'",
     "error: walls[0].wkt: must have a space, a , or a ) after a number"},
    {WALL "wkt = 'LINESTRING EMPTY'",
     "error: walls[0].wkt: must have a ( here; Z, M and EMPTY are not supported"},
    {WALL "wkt = 'LINESTRING (0 0, 1e10 0)'",
     "error: walls[0].wkt: must have a number from -1e+09 to 1e+09 here"},
};

#undef BALL
#undef SHAPE
#undef WALL

void PrintTo(const FaultyScenario& c, std::ostream* out) {
  *out << c.fault;
}

class BadInput : public ::testing::TestWithParam<FaultyScenario> {};

TEST_P(BadInput, IsFoundAtItsPlaceAndNamed) {
  const Loaded loaded = load_text(std::string("throng = 1\n") + GetParam().text);
  EXPECT_GE(loaded.errors(), 1);
  EXPECT_NE(faults(loaded).find(GetParam().fault), std::string::npos)
      << GetParam().text << "\nsays: " << faults(loaded) << "wanted: " << GetParam().fault;
}

// It happened: the advice was of another word, three bytes farther left.
TEST(BadInputFile, IsFoundBehindAByteOrderMark) {
  const std::string abc =
      "s.toml:1:8: error: this is no TOML: a value is a text in quotes, as in \"abc\", a number";
  EXPECT_EQ(faults(load_text("\xef\xbb\xbfname = abc\nthrong = 1\n")).rfind(abc, 0), 0u);
  EXPECT_EQ(faults(load_text("name = abc\nthrong = 1\n")).rfind(abc, 0), 0u);
}

INSTANTIATE_TEST_SUITE_P(All, BadInput, ::testing::ValuesIn(kFaultyScenarios));

}  // namespace
}  // namespace throng
