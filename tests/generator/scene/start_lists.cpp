// SPDX-License-Identifier: GPL-3.0-or-later
// Lists with one start for each member of a family.
#include "generator/machine.hpp"
#include "graph/derived_values.hpp"
#include "text/diagnostic.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

std::string chain(const std::string& coordinate, const std::string& state = "") {
    return "[sizes]\nN = { value = 3, range = [1, 9] }\n"
           "[parameters]\nm = { for = \"k = 1..N\", value = 2, unit = \"kg\" }\nl = { value = 0.5, unit = \"m\" }\n"
           "[coordinates]\nx = { for = \"k = 0..N-1\", unit = \"m\", " + coordinate + " }\n"
           "[states]\nz = { for = \"k = 1..N\", unit = \"m\", derivative = \"dot(x[k-1])\"" + state + " }\n"
           "[bodies.block]\nfor = \"k = 1..N\"\nmass = \"m[k]\"\nposition = [\"x[k-1]\", 0, 0]\n";
}

std::string refused(const std::string& text, const std::map<std::string, int>& sizes = {}) {
    try {
        const Machine machine = machine_from(text, "", sizes);
        return "";
    } catch (const Failure& failure) {
        return failure.diagnostics().front().message;
    }
}

}  // namespace

TEST_CASE("each member starts with its value of a list: a number, a quantity or an expression") {
    const Machine machine = machine_from(
        chain("start = [0.1, \"20 cm\", \"l/2 + k*(1 m)\"], start_rate = [1, 0, \"-3 mm/s\"]", ", start = [3, 2, \"l\"]"));
    const ex l = symbol_named(*machine.system, SymbolKind::parameter, "l");
    const auto tenth = [](int n) { return GiNaC::numeric(n, 10); };
    const std::vector<ex> expected{tenth(1), tenth(2), l / 2 + 2, 1, 0, GiNaC::numeric(-3, 1000), 3, 2, l};
    const std::vector<ex> starts = start_values(*machine.system);
    REQUIRE(starts.size() == expected.size());
    for (std::size_t i = 0; i < starts.size(); ++i) {
        CAPTURE(i);
        CHECK((starts[i] - expected[i]).expand().is_zero());
    }
}

TEST_CASE("a list is as long as its family, whose size may change") {
    const std::string three = chain("start = [1, 2, 3]");
    CHECK(refused(three).empty());
    CHECK(refused(three, {{"N", 4}}) == "the start of coordinate 'x' is a list of 3 values, but the family has 4 members, x[0] to x[3]");
    CHECK(refused(three, {{"N", 1}}) == "the start of coordinate 'x' is a list of 3 values, but the family has 1 member, x[0]");
    CHECK(refused(chain("start = [1]")) == "the start of coordinate 'x' is a list of 1 value, but the family has 3 members, x[0] to x[2]");
    CHECK(refused(chain("start = [1]"), {{"N", 1}}).empty());
    CHECK(refused(chain("start = 1", ", start = [1, 2]")) ==
          "the start of state 'z' is a list of 2 values, but the family has 3 members, z[1] to z[3]");
}
