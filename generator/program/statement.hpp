// SPDX-License-Identifier: GPL-3.0-or-later
// What functions of a plant do, as values and statements that no language has marked yet. Order and shape of operations, names, and which
// values get one are decided where statements are made; a printer of a language only writes them.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "language/rational.hpp"

namespace dalembert {

/// An immutable expression; copies share it. Values of arithmetic are real numbers of the plant's scalar type, indices whole numbers.
class Value {
public:
    enum class Kind {
        none,          ///< nothing: a declaration without a value
        literal,       ///< `number` as a real number; below 10^9, so that every scalar type converts it without a warning
        constant,      ///< `exact` as a real number; see written_out()
        pi,            ///< the circle's number
        whole,         ///< `number` as an index or count
        name,          ///< `text`: a variable, parameter or loop index of the function
        member,        ///< `text` of `object`
        element,       ///< parts: array, index
        whole_array,   ///< `text`: a vector of the interface, for a helper that takes an array of any length
        part_from,     ///< parts: array, index: the array from that element on
        list,          ///< parts: an array written out, argument of a helper
        sum,           ///< parts, of which those with `negative` are subtracted; the first may be
        product,       ///< parts: first `factors` of them multiplied (none: 1), then divided by each of the rest
        parenthesised, ///< parts: one value, in parentheses whatever it is
        call,          ///< function `text` of the parts; where it is to be found says `where`
        all_of,        ///< parts: whether every condition holds; none: true
        event,         ///< `text`: the number of an event
        interface_size,  ///< `text`: a number of the plant's interface: state_count, series_rows
        room_from,     ///< parts: an array that the caller lends, index: what stands there from that element on
        real,          ///< parts: an index, as a real number
        signed_index,  ///< parts: an index, as a whole number that others may be subtracted from
        comparison,    ///< parts: two indices; which holds between them says comparison()
        curve,         ///< `text`: the table of a measured characteristic of the plant
        choice,        ///< parts: a condition, the index where it holds, and the one where it does not
    };
    /// Whose members are read or set.
    enum class Object {
        parameters,  ///< of the plant
        cached,      ///< what depends on parameters alone, computed when they are set
        energies,    ///< the result of `together`
    };
    /// Where a called function is to be found.
    enum class Where {
        library,  ///< the language's own mathematics: sin, pow, ...
        helper,   ///< a function that a generated file brings itself: sign, log_mean, ldlt_solve, ...; for the scalar type and `sizes`
        plant,    ///< another function of the same plant: rhs, jacobian_u, ...
    };

    enum class Comparison { equal, less, greater };

    Value() = default;
    static Value literal(unsigned long number);
    static Value constant(const Rational& exact);
    static Value pi();
    static Value whole(std::size_t number);
    static Value name(std::string text);
    static Value member(Object object, std::string text);
    static Value element(Value array, Value index);
    static Value element(Value array, std::size_t index) { return element(std::move(array), whole(index)); }
    /// A vector as an argument of helpers, which take arrays.
    static Value whole_array(std::string name);
    static Value part_from(Value array, std::size_t first);
    static Value list(std::vector<Value> parts);
    static Value sum(std::vector<Value> terms, std::vector<bool> negative = {});
    static Value product(std::vector<Value> factors, std::vector<Value> divisors = {});
    static Value parenthesised(Value value);
    static Value call(Where where, std::string function, std::vector<Value> arguments, std::vector<std::size_t> sizes = {});
    static Value all_of(std::vector<Value> conditions);
    static Value event(std::string name);
    static Value interface_size(std::string name);
    static Value room_from(Value array, Value first);
    static Value real(Value index);
    static Value signed_index(Value index);
    static Value comparison(Comparison holds, Value a, Value b);
    static Value curve(std::string name);
    static Value choice(Value condition, Value then, Value otherwise);

    Kind kind() const;
    unsigned long number() const;
    const Rational& exact() const;
    Object object() const;
    Where where() const;
    const std::string& text() const;
    const std::vector<Value>& parts() const;
    const std::vector<bool>& negative() const;  ///< as many as there are parts of a sum
    std::size_t factors() const;                ///< how many parts of a product are multiplied
    const std::vector<std::size_t>& sizes() const;  ///< of a helper: whole numbers that it is made for
    Comparison comparison() const;

    bool is_zero() const { return kind() == Kind::constant && exact() == 0; }
    /// Same structure, names and numbers.
    friend bool operator==(const Value& a, const Value& b);

private:
    struct Content;
    explicit Value(Content content);
    static Value with_parts(Kind kind, std::vector<Value> parts);
    std::shared_ptr<const Content> content_;
};

/// 1 sum, 2 product or quotient, 3 what binds tighter. A constant that is more than one literal counts as a sum.
int precedence(const Value& value);

/// A constant as literals, products, quotients and sums: exact in every scalar type that holds the literals; to 45 digits where `float`
/// could not hold numerator or denominator.
Value written_out(const Rational& exact);

/// How long a value is when it is written, in characters of the notation of generated headers. Decides which parts get a name.
std::size_t width(const Value& value);

/// Whether a value calls a function of the plant, or contains the name.
bool mentions(const Value& value, const std::string& name);

/// What a variable holds.
struct Storage {
    enum class Kind {
        scalar,   ///< a real number
        array,    ///< sizes[0] real numbers that a helper fills, reads or returns
        table,    ///< sizes[0], or sizes[0] rows of sizes[1], that only the function itself uses
        indices,  ///< sizes[0] whole numbers, known before
        vector,   ///< what `name` stands for in the plant's interface: "State", "Input", "JacobianX", ...
        index,    ///< a whole number
        room,     ///< where something begins in an array that the caller lends
    };
    Kind kind = Kind::scalar;
    std::vector<std::size_t> sizes = {};
    std::string name = {};
    friend bool operator==(const Storage&, const Storage&) = default;
};

struct Statement;
using Statements = std::vector<Statement>;

/// A variable; const where it has a value, unless it `changes`. `names` are several only without one. `is_zeroed`: begins with zeros.
struct Declaration {
    Storage type;
    std::vector<std::string> names;
    Value value = {};
    bool is_zeroed = false;
    std::vector<std::size_t> numbers = {};  ///< of indices
    std::string comment = {};
    bool changes = false;
    friend bool operator==(const Declaration&, const Declaration&) = default;
};

struct Assignment {
    enum class Operation { set, add, subtract, multiply };
    Value target;
    Value value;
    Operation operation = Operation::set;
    friend bool operator==(const Assignment&, const Assignment&) = default;
};

/// A call for what it does to its arguments.
struct Invocation {
    Value call;
    friend bool operator==(const Invocation&, const Invocation&) = default;
};

/// Every number of an array of `size` becomes `value`.
struct Filling {
    std::string array;
    std::string vector;  ///< the type's name in the plant's interface
    Value value;
    friend bool operator==(const Filling&, const Filling&) = default;
};

/// index = first, ..., end - 1.
struct Loop {
    std::string index;
    std::size_t first = 0;
    Value end;
    Statements body;
    friend bool operator==(const Loop&, const Loop&);
};

/// Done where the event with this number happens.
struct OnEvent {
    std::string event;
    Statements body;
    friend bool operator==(const OnEvent&, const OnEvent&);
};

/// Done where a condition on indices holds.
struct If {
    Value condition;
    Statements body;
    friend bool operator==(const If&, const If&);
};

/// Done only where the states of the caller have room for one number behind those of the plant: the work that is done on it. Whether they
/// have is known before the function runs: in C++ from their type; the interface of a language without templates decides it once for all.
struct IfRoomForWork {
    Statements body;
    friend bool operator==(const IfRoomForWork&, const IfRoomForWork&);
};

/// Declares `input` and sets it to the inputs at this state and time. The caller gives inputs as Taylor series along the motion, which
/// keep what they need at `room`.
struct FirstInputs {
    Value states, time;
    std::string input;
    Value room;
    friend bool operator==(const FirstInputs&, const FirstInputs&) = default;
};

/// Declares `input`, coefficients of this order of the same series. After FirstInputs, order by order.
struct NextInputs {
    std::string input;
    Value order;
    friend bool operator==(const NextInputs&, const NextInputs&) = default;
};

/// By the mode of the plant. The last case is also for a number that is no mode.
struct ByMode {
    struct Case {
        std::vector<std::string> modes;
        Statements body;
        friend bool operator==(const Case&, const Case&);
    };
    std::vector<Case> cases;
    friend bool operator==(const ByMode&, const ByMode&);
};

struct Return {
    Value value;
    friend bool operator==(const Return&, const Return&) = default;
};

/// In braces: names inside are not seen outside.
struct Braces {
    Statements body;
    friend bool operator==(const Braces&, const Braces&);
};

/// An argument is not used, on purpose.
struct Unused {
    std::string name;
    friend bool operator==(const Unused&, const Unused&) = default;
};

struct Statement {
    using Content = std::variant<Declaration, Assignment, Invocation, Filling, Loop, OnEvent, ByMode, Return, Braces, Unused, If,
                                 IfRoomForWork, FirstInputs, NextInputs>;
    Content content;
    template <class T>
        requires std::is_constructible_v<Content, T>
    Statement(T one) : content(std::move(one)) {}
    friend bool operator==(const Statement&, const Statement&) = default;
};

/// An argument of a function. Names of those that are not used stay, for the reader.
struct Argument {
    enum class Passing {
        value,   ///< a scalar, mode or event number
        read,    ///< an array that is read
        result,  ///< an array that is written
        room,    ///< several of `type`, which the caller lends and the function reads and writes
    };
    /// "Scalar", "Mode", "EventNumber", "Index", a vector's name in the plant's interface: "State", "JacobianX", ..., or "StateOrMore", of
    /// which IfRoomForWork tells, or "Inputs", which gives Taylor series of inputs.
    std::string type;
    std::string name;
    Passing passing = Passing::read;
    bool is_used = true;
    friend bool operator==(const Argument&, const Argument&) = default;
};

struct FunctionBody {
    std::vector<Argument> arguments;
    Statements statements;
};

/// Whether some statement returns a value.
bool returns(const Statements& statements);
/// Whether some value or call of a plant function contains the name.
bool mentions(const Statements& statements, const std::string& name);

/// Whether members or functions of the plant occur.
bool uses_plant(const Statements& statements);

/// Functions of the language's mathematics that statements call; those in braces and of modes count for themselves.
std::set<std::string> library_calls(const Statements& statements);

}  // namespace dalembert
