// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a model of elements drawn at random from all domains: `random_models SEED` prints it. The same seed gives the same text
// on every machine, so that a failure can be repeated.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace {

/// splitmix64: the distributions of <random> differ from library to library.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : state_((seed + 1) * 0xD1342543DE82EF95ULL) { next(); }
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15ULL;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31);
    }
    int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
    bool chance(int percent) { return below(100) < percent; }
    /// A decimal of three digits between low and high, as text: exact in the model.
    std::string decimal(double low, double high) {
        const long thousandths = std::lround(1000 * low) + static_cast<long>(next() % static_cast<std::uint64_t>(std::lround(1000 * (high - low)) + 1));
        const std::string digits = std::to_string(1000 + std::labs(thousandths) % 1000).substr(1);
        return (thousandths < 0 ? "-" : "") + std::to_string(std::labs(thousandths) / 1000) + "." + digits;
    }

private:
    std::uint64_t state_;
};

/// The sections of a model file, in the order in which they are first written to.
class Model {
public:
    void add(const std::string& section, const std::string& line) {
        if (lines_.find(section) == lines_.end()) order_.push_back(section);
        lines_[section].push_back(line);
    }
    void parameter(const std::string& name, const std::string& value, const std::string& unit) {
        add("parameters", name + " = { value = " + value + ", unit = \"" + unit + "\" }");
    }
    void output(const std::string& name, const std::string& value, const std::string& unit) {
        add("outputs", name + " = { value = \"" + value + "\", unit = \"" + unit + "\" }");
    }
    void write(std::ostream& out) const {
        for (const std::string& section : order_) {
            out << '[' << section << "]\n";
            for (const std::string& line : lines_.at(section)) out << line << '\n';
            out << '\n';
        }
    }

private:
    std::vector<std::string> order_;
    std::map<std::string, std::vector<std::string>> lines_;
};

/// What is drawn from so far: parts that are added later act on coordinates and dampers of earlier ones.
struct Machine {
    Draw draw;
    Model model;
    std::vector<std::string> sliders;  ///< coordinates in m that are positions along x
    std::vector<std::string> dampers;
    std::string inputs;
    int groups = 0;  ///< of modes; their combinations multiply
    int count = 0;
    bool has_oil = false, has_gas = false, has_water = false, has_air = false, has_rod = false;

    std::string name(const char* what) { return std::string(what) + "_" + std::to_string(++count); }
    std::string slider() { return sliders[static_cast<std::size_t>(draw.below(static_cast<int>(sliders.size())))]; }
};

void add_slider(Machine& m) {
    const std::string x = m.name("x"), mass = m.name("m"), c = m.name("c"), d = m.name("d");
    m.model.parameter(mass, m.draw.decimal(0.5, 3), "kg");
    m.model.parameter(c, m.draw.decimal(20, 200), "N/m");
    m.model.parameter(d, m.draw.decimal(0.1, 2), "N*s/m");
    m.model.add("coordinates", x + " = { unit = \"m\", start = " + m.draw.decimal(0.05, 0.2) + ", start_rate = " + m.draw.decimal(-0.5, 0.5) + " }");
    m.model.add("bodies", "body_" + x + " = { mass = \"" + mass + "\", position = [\"" + x + "\", 0, 0] }");
    m.model.add("springs", "spring_" + x + " = { elongation = \"" + x + "\", stiffness = \"" + c + "\" }");
    m.model.add("dampers", "damper_" + x + " = { rate = \"dot(" + x + ")\", coefficient = \"" + d + "\" }");
    m.model.output("loss_" + x, "dissipated_power[damper_" + x + "]", "W");
    m.sliders.push_back(x);
    m.dampers.push_back("damper_" + x);
}

void add_pendulum(Machine& m) {
    const std::string phi = m.name("phi"), x = m.slider(), mass = m.name("m"), l = m.name("l");
    m.model.parameter(mass, m.draw.decimal(0.2, 1), "kg");
    m.model.parameter(l, m.draw.decimal(0.3, 1), "m");
    m.model.add("coordinates", phi + " = { unit = \"rad\", start = " + m.draw.decimal(-1, 1) + " }");
    m.model.add("bodies", "bob_" + phi + " = { on = \"body_" + x + "\", mass = \"" + mass + "\", position = [\"" + l + "*sin(" + phi + ")\", \"-" + l + "*cos(" + phi + ")\", 0] }");
    m.model.output("height_" + phi, "position[bob_" + phi + ", 2]", "m");
}

void add_coupling(Machine& m) {
    if (m.sliders.size() < 2) return;
    const std::string c = m.name("c");
    m.model.parameter(c, m.draw.decimal(10, 100), "N/m");
    m.model.add("springs", "link_" + c + " = { elongation = \"" + m.sliders.front() + " - " + m.sliders.back() + "\", stiffness = \"" + c + "\" }");
}

void add_friction(Machine& m) {
    if (m.groups >= 2) return;
    ++m.groups;
    const std::string f = m.name("f"), x = m.slider(), N = m.name("N");
    m.model.parameter(N, m.draw.decimal(0.5, 5), "N");
    m.model.add("frictions", f + " = { rate = \"dot(" + x + ")\", normal_force = \"" + N + "\", coefficient = " + m.draw.decimal(0.2, 0.6) + ", static_coefficient = " + m.draw.decimal(0.6, 1) + " }");
    m.model.output("force_" + f, "constraint_force[" + f + "]", "N");
}

void add_stop(Machine& m) {
    if (m.groups >= 2) return;
    ++m.groups;
    const std::string s = m.name("stop"), x = m.slider(), gap = m.name("g");
    m.model.parameter(gap, m.draw.decimal(0.01, 0.2), "m");
    const bool bounces = m.draw.chance(70);
    m.model.add("stops", s + " = { gap = \"" + x + " + " + gap + "\"" + (bounces ? ", restitution = " + m.draw.decimal(0.1, 0.8) : "") + " }");
    m.model.output("force_" + s, "constraint_force[" + s + "]", "N");
}

void add_contact(Machine& m) {
    if (m.groups >= 2) return;
    ++m.groups;
    const std::string k = m.name("contact"), x = m.slider(), c = m.name("c");
    m.model.parameter(c, m.draw.decimal(500, 5000), "N/m");
    m.model.add("contacts", k + " = { elongation = \"" + x + "" + " - 3*l_0/20\", stiffness = \"" + c + "\" }");
}

void add_input_force(Machine& m) {
    const std::string u = m.name("u"), x = m.slider();
    m.model.add("inputs", u + " = { unit = \"N\" }");
    m.model.add("forces", "push_" + u + " = { on = \"body_" + x + "\", force = [\"" + u + "\", 0, 0] }");
    m.inputs += (m.inputs.empty() ? "" : ", ") + u + " = \"F_0*sin(2*pi*t/t_0 + " + m.draw.decimal(0, 3) + ")\"";
}

void add_pulse(Machine& m) {
    const std::string f = m.name("pulse"), x = m.slider(), at = m.name("t");
    m.model.parameter(at, m.draw.decimal(0.1, 0.9), "s");
    m.model.add("forces", f + " = { on = \"body_" + x + "\", force = [\"10*F_0*max(0, 1 - abs(t - " + at + ")/(t_0/200))\", 0, 0] }");
}

void add_profile(Machine& m) {
    if (m.groups >= 2) return;
    ++m.groups;
    const std::string p = m.name("profile"), x = m.slider(), at = m.name("t");
    m.model.parameter(at, m.draw.decimal(0.1, 0.9), "s");
    m.model.add("profiles", p + " = { phases = [{ name = \"on\", value = \"2*F_0\", until = \"" + at + "\" }, { name = \"off\", value = \"-F_0\" }] }");
    m.model.add("forces", "drive_" + p + " = { on = \"body_" + x + "\", force = [\"" + p + "\", 0, 0] }");
}

void add_oil_chamber(Machine& m) {
    if (!m.has_oil) {
        m.model.parameter("rho_oil", "850", "kg/m^3");
        m.model.parameter("beta", "15000", "bar");
        m.model.parameter("p_s", "8", "bar");
        m.model.parameter("p_t", "1", "bar");
        m.model.parameter("A_k", "2", "cm^2");
        m.model.parameter("a_k", "20", "mm^2");
        m.model.parameter("p_w", "0.05", "bar");
        m.model.parameter("k_l", "1e-11", "m^3/(s*Pa)");
        m.model.parameter("x_d", "1", "m");
        m.model.add("media", "oil = { law = \"liquid\", density = \"rho_oil\", bulk_modulus = \"beta\", reference_pressure = \"p_t\" }");
        m.model.add("reservoirs", "supply = { medium = \"oil\", pressure = \"p_s\" }");
        m.model.add("reservoirs", "sump = { medium = \"oil\", pressure = \"p_t\" }");
        m.has_oil = true;
    }
    const std::string v = m.name("chamber"), x = m.slider(), p = "p_" + v;
    const bool exact = m.draw.chance(40);
    m.model.add("states", p + " = { unit = \"bar\", start = " + m.draw.decimal(1.5, 6) + ", range = [0.5, 100] }");
    m.model.add("volumes", v + " = { medium = \"oil\", volume = \"A_k*(x_d + " + x + ")\", pressure = \"" + p + "\" }");
    m.model.add("flows", "in_" + v + " = { from = \"supply\", to = \"" + v + "\", law = \"hydraulic_orifice\", area = \"a_k\", coefficient = 0.7" + (exact ? "" : ", width = \"p_w\"") + " }");
    m.model.add("flows", "leak_" + v + " = { from = \"" + v + "\", to = \"sump\", law = \"laminar\", conductance = \"k_l\" }");
    m.model.output("flow_" + v, "volume_flow[in_" + v + "]", "m^3/s");
    m.model.output("mass_" + v, "mass[" + v + "]", "kg");
}

void add_gas_chamber(Machine& m) {
    if (!m.has_gas) {
        m.model.parameter("R_g", "287", "J/(kg*K)");
        m.model.parameter("c_v", "718", "J/(kg*K)");
        m.model.parameter("T_g", "293", "K");
        m.model.parameter("p_g", "3", "bar");
        m.model.parameter("A_g", "5", "cm^2");
        m.model.parameter("a_g", "0.2", "mm^2");
        m.model.parameter("x_g", "0.8", "m");
        m.model.add("media", "air = { law = \"ideal_gas\", gas_constant = \"R_g\", isochoric_heat = \"c_v\" }");
        m.model.add("reservoirs", "bottle = { medium = \"air\", pressure = \"p_g\", temperature = \"T_g\" }");
        m.has_gas = true;
    }
    const std::string v = m.name("gas"), x = m.slider(), p = "p_" + v, T = "T_" + v;
    m.model.add("states", p + " = { unit = \"bar\", start = " + m.draw.decimal(1, 2) + ", range = [0.3, 20] }");
    m.model.add("states", T + " = { unit = \"K\", start = " + m.draw.decimal(280, 310) + ", range = [150, 600] }");
    m.model.add("volumes", v + " = { medium = \"air\", volume = \"A_g*(x_g - " + x + ")\", pressure = \"" + p + "\", temperature = \"" + T + "\" }");
    m.model.add("flows", "fill_" + v + " = { from = \"bottle\", to = \"" + v + "\", law = \"pneumatic_orifice\", area = \"a_g\", coefficient = 0.8 }");
    m.model.output("flow_" + v, "mass_flow[fill_" + v + "]", "kg/s");
    m.model.output("energy_" + v, "internal_energy[" + v + "]", "J");
}

void add_tanks(Machine& m) {
    if (!m.has_water) {
        m.model.parameter("rho_w", "1000", "kg/m^3");
        m.model.parameter("p_a", "1", "bar");
        m.model.parameter("A_w", "0.1", "m^2");
        m.model.parameter("a_w", "4", "cm^2");
        m.model.add("media", "water = { law = \"incompressible\", density = \"rho_w\" }");
        m.has_water = true;
    }
    const std::string a = m.name("tank"), b = m.name("tank");
    for (const std::string& tank : {a, b}) {
        m.model.add("states", "h_" + tank + " = { unit = \"m\", start = " + m.draw.decimal(0.5, 2) + ", range = [0.1, 3] }");
        const bool is_high = m.draw.chance(30);
        m.model.add("volumes", tank + " = { medium = \"water\", volume = \"A_w*h_" + tank + "\", filling = \"h_" + tank + "\", pressure = \"p_a\", head = \"h_" + tank + "\", gravity = \"g\"" + (is_high ? ", potential = \"g*l_0/2\"" : "") + " }");
    }
    const bool laminar = m.draw.chance(40);
    m.model.add("flows", "between_" + a + " = { from = \"" + a + "\", to = \"" + b + "\", " + (laminar ? "law = \"laminar\", conductance = \"a_w/(rho_w*g*l_0)*l_0/t_0\"" : "law = \"hydraulic_orifice\", area = \"a_w\", coefficient = 0.6") + " }");
    m.model.output("flow_" + a, "volume_flow[between_" + a + "]", "m^3/s");
    m.model.output("depth_" + a, "pressure[" + a + "]", "Pa");
}

void need_air(Machine& m) {
    if (m.has_air) return;
    m.model.parameter("T_a", "293", "K");
    m.model.add("nodes", "room = { temperature = \"T_a\" }");
    m.has_air = true;
}

void add_hot_body(Machine& m) {
    need_air(m);
    const std::string n = m.name("hot"), C = m.name("C"), G = m.name("G");
    m.model.parameter(C, m.draw.decimal(1, 20), "J/K");
    m.model.parameter(G, m.draw.decimal(0.1, 2), "W/K");
    m.model.add("states", "T_" + n + " = { unit = \"K\", start = " + m.draw.decimal(280, 400) + ", range = [200, 800] }");
    m.model.add("nodes", n + " = { temperature = \"T_" + n + "\", capacity = \"" + C + "\", heat = \"dissipated_power[" + m.dampers[static_cast<std::size_t>(m.draw.below(static_cast<int>(m.dampers.size())))] + "]\" }");
    m.model.add("links", "loss_" + n + " = { from = \"" + n + "\", to = \"room\", conductance = \"" + G + "\" }");
    if (m.draw.chance(50)) m.model.add("links", "glow_" + n + " = { from = \"" + n + "\", to = \"room\", law = \"radiation\", area = \"l_0^2/100\", emissivity = 0.8 }");
    m.model.output("heat_" + n, "heat[loss_" + n + "]", "W");
}

void add_rod(Machine& m) {
    need_air(m);
    if (!m.has_rod) {
        m.model.parameter("lambda_0", "40", "W/(m*K)");
        m.model.parameter("rho_0", "1000", "kg/m^3");
        m.model.parameter("c_0", "400", "J/(kg*K)");
        m.model.parameter("alpha_0", "20", "W/(m^2*K)");
        m.model.parameter("T_r", "343", "K");
        m.has_rod = true;
    }
    const std::string r = m.name("rod");
    const int cells = 3 + m.draw.below(4);
    const bool loops = m.draw.chance(50), cooled = m.draw.chance(50);
    m.model.add("states", "T_" + r + " = { for = \"k = 1.." + std::to_string(cells) + "\", unit = \"K\", start = " + m.draw.decimal(290, 380) + ", range = [200, 800] }");
    m.model.add("rods", r + " = { temperature = \"T_" + r + "\", scheme = \"cells\", length = \"l_0/5\", area = \"l_0^2/1000\", conductivity = " + (!cooled && m.draw.chance(40) ? std::string("\"T -> lambda_0*(1 + T/(3*T_a))\"") : std::string("\"lambda_0\"")) +
        ", density = \"rho_0\", heat_capacity = \"c_0\", first = { temperature = \"T_r\" }, last = { " + (cooled ? "coefficient = \"alpha_0\", ambient = \"T_a\"" : "flux = 0") + " }" + (loops ? ", loops = true" : "") + " }");
    m.model.output("heat_" + r, "heat[" + r + ".first]", "W");
}

void add_meter(Machine& m) {
    m.model.add("states", m.name("meter") + " = { unit = \"J\", derivative = \"F_0*dot(" + m.slider() + ")\" }");
}

void write_model(std::uint64_t seed, std::ostream& out) {
    Machine m{Draw(seed), {}, {}, {}, {}};
    m.model.add("model", "format = 1");
    m.model.add("model", "name   = \"random_" + std::to_string(seed) + "\"");
    m.model.parameter("g", "9.81", "m/s^2");
    m.model.parameter("l_0", "1", "m");
    m.model.parameter("t_0", "1", "s");
    m.model.parameter("F_0", m.draw.decimal(1, 20), "N");
    m.model.add("gravity", "acceleration = [0, \"-g\", 0]");
    add_slider(m);
    using Part = void (*)(Machine&);
    const Part parts[] = {add_slider, add_pendulum, add_coupling, add_friction, add_stop, add_contact, add_input_force, add_pulse, add_profile,
                          add_oil_chamber, add_gas_chamber, add_tanks, add_hot_body, add_rod, add_meter};
    const int number = 3 + m.draw.below(4);
    for (int i = 0; i < number; ++i) parts[m.draw.below(static_cast<int>(std::size(parts)))](m);
    for (const char* energy : {"kinetic_energy", "potential_energy", "internal_energy"}) m.model.output(std::string("all_") + energy, energy, "J");
    for (const char* power : {"supplied_power", "dissipated_power", "exchanged_power"}) m.model.output(std::string("all_") + power, power, "W");
    m.model.add("runs.reference", "until = 1");
    m.model.add("runs.reference", "samples = 50");
    if (!m.inputs.empty()) m.model.add("runs.reference", "inputs = { " + m.inputs + " }");
    out << "# SPDX-License-Identifier: BSL-1.0\n";
    m.model.write(out);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "random_models SEED\n";
        return 2;
    }
    write_model(std::strtoull(argv[1], nullptr, 10), std::cout);
    return std::cout ? 0 : 3;
}
