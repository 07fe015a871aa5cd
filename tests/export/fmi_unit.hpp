// SPDX-License-Identifier: GPL-3.0-or-later
// An FMU as an importer sees it that knows the standard alone: its archive, its modelDescription.xml, and the functions of its binary.
// Both versions of the standard behind one interface.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fmi_test {

using Vector = std::vector<double>;
using References = std::vector<unsigned>;

/// As both standards number them.
enum Status { ok, warning, discard, error, fatal };

struct Variable {
    std::string name, causality, variability, initial, unit, type;
    unsigned reference = 0;
    std::optional<double> start, low, high;
    std::optional<std::size_t> derivative_of;  ///< place of the state among the variables
};

/// An unknown of ModelStructure, and the places of the variables that it depends on; nothing: on all.
struct Unknown {
    std::size_t variable = 0;
    std::optional<std::vector<std::size_t>> dependencies;
};

struct Description {
    int version = 0;
    std::string token, identifier;
    std::vector<Variable> variables;
    std::vector<Unknown> outputs, derivatives, initial;
    std::size_t indicators = 0;
    std::optional<double> stop, tolerance;
    bool needs_completed_step = false;

    References references(const std::string& causality) const;
    References states() const;
    References rates() const;
    std::optional<unsigned> mode() const;
};

/// Unpacks an FMU into a folder and reads its modelDescription.xml. Throws std::runtime_error.
Description unpack(const std::string& path, const std::string& folder);

struct News {
    bool again = false, over = false, states_changed = false;
    double next = std::numeric_limits<double>::infinity();  ///< time event, s
};

/// One instance.
class Instance {
public:
    virtual ~Instance() = default;
    virtual Status setup(double tolerance, double start, double stop) = 0;  ///< and enters initialization mode
    virtual Status end_setup() = 0;
    virtual Status get(const References& references, Vector& values) = 0;
    virtual Status set(const References& references, const Vector& values) = 0;
    virtual long mode(unsigned reference) = 0;
    virtual Status enter_events() = 0;
    virtual Status update(News& news) = 0;
    virtual Status enter_continuous() = 0;
    virtual Status completed(bool& wants_events, bool& over) = 0;
    virtual Status set_time(double t) = 0;
    virtual Status set_states(const Vector& x) = 0;
    virtual Status rates(Vector& values) = 0;
    virtual Status indicators(Vector& values) = 0;
    virtual Status states(Vector& values) = 0;
    virtual Status directional(const References& unknowns, const References& knowns, const Vector& seed, Vector& result) = 0;
    virtual Status adjoint(const References& unknowns, const References& knowns, const Vector& seed, Vector& result) = 0;
    virtual Status step(double from, double length, bool& over, double& reached) = 0;
    virtual Status terminate() = 0;
    virtual Status reset() = 0;
    virtual Status save(void*& state) = 0;
    virtual Status load(void* state) = 0;
    virtual Status forget(void*& state) = 0;
    virtual Status serialise(void* state, std::string& bytes) = 0;
    virtual Status deserialise(const std::string& bytes, void*& state) = 0;
};

/// An unpacked FMU with its binary loaded. Throws std::runtime_error.
class Unit {
public:
    explicit Unit(const std::string& path);
    ~Unit();
    Unit(const Unit&) = delete;
    const Description& description() const { return description_; }
    void* binary() const { return binary_; }
    /// Null where the FMU refuses. `token`: another one than that of the description.
    std::unique_ptr<Instance> instantiate(bool is_co_simulation, const std::string& name = "one", const std::string& token = "") const;

private:
    Description description_;
    std::string folder_;
    void* binary_ = nullptr;
};

/// Messages that instances have sent since the last look.
std::vector<std::string>& messages();

}  // namespace fmi_test
