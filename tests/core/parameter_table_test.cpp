// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/core/parameter_table.hpp"

#include <limits>

#include "sslam/core/types.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;

struct InnerOptions {
  double radius = 20;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("radius", self.radius, Unit::kPixels, 1, kUnbounded, "of the search");
  }
};

struct Options {
  int rounds = 3;
  double share = 0.5;
  double angle = radians(0.1);
  double widest = radians(7.0);
  bool lines = true;
  InnerOptions match;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("rounds", self.rounds, Unit::kCount, 1, 10, "of the solver");
    visit("share", self.share, Unit::kShare, 0, 1, "of the matches");
    visit("angle", self.angle, Unit::kDegrees, 0, 90, "between two walls");
    visit("widest", self.widest, Unit::kDegrees, 0, 90, "kernel");
    visit("lines", self.lines, Unit::kCount, 0, 1, "take part");
    visit_within("match.", self.match, visit);
  }
};
static_assert(Described<Options> && Described<InnerOptions> && !Described<int>);

struct Fixture {
  Options options;
  ParameterTable table;

  Fixture() {
    table.collect([&](auto& visit) { visit_within("stage.", options, visit); });
    table.add_order({"stage.angle", "stage.widest", "nothing would be found"});
  }
  void write() {
    table.write([&](auto& visit) { visit_within("stage.", options, visit); });
  }
};

TEST_CASE("a parameter table has each member with its prefix, unit, range and default") {
  const Fixture f;
  REQUIRE(f.table.entries().size() == 6);
  const Parameter* angle = f.table.find("stage.angle");
  REQUIRE(angle != nullptr);
  REQUIRE(angle->initial == 0.1);
  REQUIRE(angle->unit == Unit::kDegrees);
  REQUIRE(angle->most == 90);
  REQUIRE(angle->meaning == "between two walls");
  REQUIRE_FALSE(angle->whole);
  REQUIRE(f.table.find("stage.rounds")->whole);
  REQUIRE(f.table.find("stage.match.radius")->initial == 20);
  REQUIRE(f.table.find("radius") == nullptr);
}

TEST_CASE("a parameter table writes what was set and leaves the rest to the bit") {
  Fixture f;
  const double angle = f.options.angle;
  REQUIRE(f.table.set("stage.widest", 9).ok());
  REQUIRE(f.table.set("stage.match.radius", 30).ok());
  REQUIRE(f.table.set("stage.lines", 0).ok());
  f.write();
  REQUIRE(f.options.widest == radians(9.0));
  REQUIRE(f.options.match.radius == 30);
  REQUIRE_FALSE(f.options.lines);
  REQUIRE(f.options.angle == angle);
  REQUIRE(f.options.rounds == 3);
}

TEST_CASE("a parameter table refuses what a parameter cannot be and says why") {
  Fixture f;
  const auto require_refused = [&](const char* name, double value, ParameterFault fault,
                                   const char* message) {
    const ParameterAnswer answer = f.table.set(name, value);
    REQUIRE(answer.fault == fault);
    REQUIRE(answer.message == message);
  };
  require_refused("stage.share", 1.4, ParameterFault::kOutOfRange,
                  "stage.share=1.4: out of range: 0 to 1, in share");
  require_refused("stage.match.radius", 0.5, ParameterFault::kOutOfRange,
                  "stage.match.radius=0.5: out of range: at least 1, in pixels");
  require_refused("stage.rounds", 2.5, ParameterFault::kNotWhole, "stage.rounds=2.5: not a whole number");
  require_refused("stage.share", std::numeric_limits<double>::quiet_NaN(), ParameterFault::kNotFinite,
                  "stage.share=nan: not a finite number");
  require_refused("stage.match.radius", std::numeric_limits<double>::infinity(), ParameterFault::kNotFinite,
                  "stage.match.radius=inf: not a finite number");
  require_refused("stage.anlge", 1, ParameterFault::kUnknown,
                  "stage.anlge: no such parameter here; did you mean stage.angle?");
  require_refused("nonsense", 1, ParameterFault::kUnknown, "nonsense: no such parameter here");
  f.write();
  REQUIRE(f.options.share == 0.5);
  REQUIRE(f.options.rounds == 3);
}

TEST_CASE("a parameter that must stay below another is held there") {
  Fixture f;
  REQUIRE(f.table.check().ok());
  REQUIRE(f.table.set("stage.angle", 8).ok());
  const ParameterAnswer answer = f.table.check();
  REQUIRE(answer.fault == ParameterFault::kDisordered);
  REQUIRE(answer.message == "stage.angle: 8 is not below the 7 of stage.widest: nothing would be found");
  REQUIRE(f.table.set("stage.widest", 10).ok());
  REQUIRE(f.table.check().ok());
}

TEST_CASE("the closest word is the one that a slip of the hand makes") {
  REQUIRE(closest_word("seed", {"scene", "seeds", "set"}) == "seeds");
  REQUIRE(closest_word("preset", {"seeds", "normals"}).empty());
  REQUIRE(edit_distance("", "abc") == 3);
  REQUIRE(edit_distance("kitten", "sitting") == 3);
}

}  // namespace
