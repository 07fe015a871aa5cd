// SPDX-License-Identifier: GPL-3.0-or-later
// Forms that lose digits get other ones: each rule where it helps, proven equal, with its gain measured; what is good stays as it is.
#include "graph/rewrite.hpp"

#include <algorithm>

#include "generator/machine.hpp"
#include "graph/lower.hpp"
#include "graph/raise.hpp"
#include "graph/verify.hpp"
#include "prove/equivalence.hpp"

using namespace dalembert;

namespace {

/// y of x, z in [-1, 1], a, b in [0.5, 2] and k in [1, 1e6].
Machine with_output(const std::string& output) {
    return machine_from("[parameters]\nm = { value = 1, unit = \"kg\" }\nl = { value = 1, unit = \"m\" }\nk = { value = 2, unit = \"1\", range = [1, 1e6] }\n"
                        "[coordinates]\nx = { unit = \"1\", range = [-1, 1] }\nz = { unit = \"1\", range = [-1, 1] }\na = { unit = \"1\", start = 1, range = [0.5, 2] }\nb = { unit = \"1\", start = 1, range = [0.5, 2] }\n"
                        "[bodies.one]\nmass = \"m\"\nposition = [\"l*x\", \"l*z\", 0]\n[bodies.other]\nmass = \"m\"\nposition = [\"l*a\", \"l*b\", 0]\n[outputs]\ny = { value = \"" +
                        output + "\", unit = \"1\" }\n");
}

const Rewriting* find(const Code& code, const std::string& rule, const std::string& where = "outputs") {
    const auto found = std::find_if(code.rewritten.begin(), code.rewritten.end(), [&](const Rewriting& r) { return r.rule == rule && r.where == where; });
    return found == code.rewritten.end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("the identity of each rule is proven for letters, also of two rules one after the other") {
    std::set<std::string> seen;
    for (const char* output : {"k*z*cos(a*x) - k*z + b", "k*exp(a*x) - k + z", "k*z*exp(a*x) - k*z*exp(b*x)", "1/(exp(a*x) - 1)", "exp(k)/(exp(k) + a)^2", "sinh(k*a)*cosh(k*b)/sinh(k*z)", "z*log_ratio(a, b) - z*log_ratio(k, b)", "log_ratio(a, b) - log_ratio(a, k)", "z*exp(2*x) - z", "z*log(1 + a*x) + b", "k*(a + x)^2 - k*a^2", "z*(a + b*x)^4 - z*a^4", "z*sqrt(a + x) - z*sqrt(a)",
                               "sqrt(a^2 + x^2) - a", "z*a^k - z*b^k", "x - (k*x + z)/(k + a)", "z*sin(a*x)/(a*x)", "(1 - cos(a*x))/x^2", "(exp(a*x) - 1)/x", "log(1 + a*x)/x",
                               "k*(cos(a*x)/x - sin(a*x)/(a*x^2))", "sin(a*x)/x^2 - 2*(1 - cos(a*x))/(a*x^3)", "exp(a*x)/x - exp(a*x)/(a*x^2) + 1/(a*x^2)",
                               "1/((1 + a*x)*x) - log(1 + a*x)/(a*x^2)", "z*x*cos(x) - z*sin(x)", "exp(cos(x) - 1)"}) {
        CAPTURE(std::string(output));
        const Machine machine = with_output(output);
        Atoms atoms(machine.system->symbols);
        const GiNaC::ex derived = machine.system->outputs[0].value;
        Prover prover(*machine.system);
        FormMemory memory;
        const auto check = [&](const OtherForm& form) {
            CAPTURE(std::string(form.rule));
            const auto found = prover.equal(raised(form.form, atoms), derived);
            const Verdict verdict = found.verdict;
            CAPTURE(found.reason);
            // What has a real exponent has a value above zero only.
            const bool is_power = std::string(form.rule) == "differences of real powers";
            CAPTURE(static_cast<int>(verdict));
            CHECK((verdict == Verdict::proven || (is_power && verdict == Verdict::proven_under_assumption)));
            seen.insert(form.rule);
        };
        const std::vector<OtherForm> first = other_forms(lower(derived, atoms), atoms, memory);
        CHECK_FALSE(first.empty());
        for (const OtherForm& form : first) {
            check(form);
            for (const OtherForm& second : std::vector<OtherForm>(other_forms(form.form, atoms, memory))) check(second);
        }
    }
    for (const RewriteRule& rule : rewrite_rules()) {
        CAPTURE(std::string(rule.name));
        CHECK(seen.contains(rule.name));
    }
}

TEST_CASE("each rule is applied where it helps, is proven to change nothing, and gains what it says") {
    struct Row {
        const char *rule, *output;
        double before, after;  ///< the loss is at least this, what is left at most that
    };
    const std::vector<Row> rows{
        {"1 - cos(x)", "1 - cos(x)", 1e12, 2},
        {"exp(x) - 1", "exp(x) - 1", 1e10, 2},
        {"differences of exponentials", "exp(x) - exp(a*x)", 1e10, 2},
        {"differences of log(a/b)", "log_ratio(a, k) - log_ratio(b, k)", 10, 2},
        {"quotients that overflow", "exp(k*a)/(exp(k*a) - 1)^2", 1e300, 2},
        {"quotients that overflow", "sinh(k*a)/sinh(k*(a + 1))", 1e300, 4},
        {"quotients that overflow", "cosh(k*a)/sinh(k*(a + b))", 1e300, 4},
        {"log(1 + x)", "log(1 + x)", 1e10, 2},
        {"differences of powers of sums", "(1 + x)^2 - 1", 1e10, 4},
        {"differences of powers of sums", "(1 + x)^4 - 1", 1e10, 4},
        {"differences of roots", "sqrt(1 + x^2) - 1", 1e12, 2},
        {"a quotient that cancels", "x - (k*x + z)/(k + 1)", 1e3, 3},
        {"removable 0/0", "sin(x)/x", 1e300, 2},
        {"slopes of removable 0/0", "cos(x)/x - sin(x)/x^2", 1e300, 2},
        {"slopes of removable 0/0", "sin(x)/x^2 - 2*(1 - cos(x))/x^3", 1e300, 2},
        {"slopes of removable 0/0", "exp(x)/x - (exp(x) - 1)/x^2", 1e300, 2},
        {"slopes of removable 0/0", "1/(x*(1 + x)) - log(1 + x)/x^2", 1e300, 2},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.output));
        const Machine machine = with_output(row.output);
        const auto code = make_code(*machine.system);
        const Rewriting* applied = find(*code, row.rule);
        CHECK(applied != nullptr);
        if (applied == nullptr) continue;
        CHECK(applied->before > row.before);
        CHECK(applied->after <= row.after);
        for (const AuditEntry& entry : verify(*code)) {
            CAPTURE(entry.name);
            CHECK(entry.result.verdict == Verdict::proven);
        }
        CHECK(make_code(*machine.system, {.passes = {.rewriting = false}})->rewritten.empty());
    }
}

TEST_CASE("what loses no more than its inputs do stays as it is") {
    for (const char* output : {"cos(x) + 2", "a^2 - b^2", "a^4 - b^4", "sqrt(a) - sqrt(b)", "exp(x) - 2", "log(a)", "2 - cos(x)", "sqrt(a^2 + b^2)", "a - b/(a + b)"}) {
        CAPTURE(std::string(output));
        CHECK(make_code(*with_output(output).system)->rewritten.empty());
    }
}

TEST_CASE("differences of squares, fourth powers and roots of variables, hypot, and sums of widely different size lose no more than rounding the result and its inputs does") {
    for (const char* output : {"a^2 - b^2", "a^4 - b^4", "sqrt(a) - sqrt(b)", "sqrt(x^2 + z^2)", "1e9*x + z - 1e-9*a + 1e3*b - 1e9*z + 1e-6*k - 7*x*z", "a - b/(a + b)"}) {
        CAPTURE(std::string(output));
        const Machine machine = with_output(output);
        Atoms atoms(machine.system->symbols);
        Rewriter rewriter(*machine.system, atoms, {}, {});
        const Polynomial p = lower(machine.system->outputs[0].value, atoms);
        CHECK(rewriter.largest_error(p, p) <= 3);
    }
}

TEST_CASE("a rewritten form that says something else is found") {
    // (1 - cos(x)) stands for two functions here, of which one is wrong: the proof has to see it.
    const Machine machine = with_output("1 - cos(x)"), other = with_output("1 - cos(z)");
    const auto code = make_code(*machine.system);
    FunctionCode& f = (*code)[Function::output];
    const auto wrong = make_code(*other.system);
    f.program = (*wrong)[Function::output].program;
    f.results = (*wrong)[Function::output].results;
    const std::vector<AuditEntry> entries = verify(*code);
    CHECK(std::any_of(entries.begin(), entries.end(), [](const AuditEntry& entry) { return entry.result.verdict == Verdict::wrong; }));
}
