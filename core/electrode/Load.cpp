#include "core/electrode/Load.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "core/base/LocaleFreeText.h"
#include "core/electrode/LoadResponse.h"

namespace tacto {
namespace {

constexpr std::string_view kAccepted =
    "a resistance (\"500 ohm\", \"10k\"), \"open\", \"short\" or \"200 ohm + 10 kohm || 50 nF\", then any of "
    "\", halves at 20 V\", \", drift 0.1 %/s\", \", open 1.5 s to 1.7 s\", \", intermittent 5 % seed 3\"";

std::optional<double> within(std::optional<double> value, double low, double high) {
    // Allow for rounding in unit conversion at both ends.
    if (!value || !(*value >= low - 1e-9 * std::abs(low)) || !(*value <= high + 1e-9 * std::abs(high)))
        return std::nullopt;
    return value;
}

std::optional<double> parseOhms(std::string_view text) {
    for (const std::string_view unit : {"ohms", "ohm", "Ohm", "Ω", "Ω"}) {
        if (text.ends_with(unit)) return within(parseQuantity(text, unit), kShortOhms, 1e9);
    }
    return within(parseQuantity(text, "ohm"), kShortOhms, 1e9);
}

std::optional<double> parseFarads(std::string_view text) {
    if (!text.ends_with('F')) return std::nullopt;  // a number without a unit is ambiguous
    return within(parseQuantity(text, "F"), 1e-12, 1e-3);
}

std::optional<Load> parseCircuit(std::string_view text) {
    if (text == "open") return Load::openCircuit();
    if (text == "short") return Load::shortCircuit();
    const auto plus = text.find('+');
    if (plus == std::string_view::npos) {
        const auto r = parseOhms(text);
        if (!r) return std::nullopt;
        return Load::resistor(Ohms(*r));
    }
    std::string_view parallel = trimmed(text.substr(plus + 1));
    if (parallel.starts_with('(') && parallel.ends_with(')')) parallel = parallel.substr(1, parallel.size() - 2);
    std::size_t bars = std::string_view::npos;
    std::size_t width = 0;
    for (const std::string_view sign : {"||", "∥"}) {
        if (const auto at = parallel.find(sign); at != std::string_view::npos) {
            bars = at;
            width = sign.size();
        }
    }
    if (bars == std::string_view::npos) return std::nullopt;
    const auto rs = parseOhms(trimmed(text.substr(0, plus)));
    const auto rp = parseOhms(trimmed(parallel.substr(0, bars)));
    const auto c = parseFarads(trimmed(parallel.substr(bars + width)));
    if (!rs || !rp || !c) return std::nullopt;
    return Load::skin(Ohms(*rs), Ohms(*rp), Nanofarads(*c * 1e9));
}

std::string_view after(std::string_view text, std::string_view start) {
    return text.starts_with(start) ? trimmed(text.substr(start.size())) : std::string_view{};
}

bool parseWindow(std::string_view text, Load& load) {
    const auto to = text.find(" to ");
    if (to == std::string_view::npos || load.windowCount >= load.windows.size()) return false;
    const auto begin = within(parseQuantity(text.substr(0, to), "s"), 0, 1e9);
    const auto end = within(parseQuantity(text.substr(to + 4), "s"), 0, 1e9);
    if (!begin || !end || !(*end > *begin)) return false;
    load.windows[load.windowCount++] = {*begin, *end};
    return true;
}

bool parseIntermittent(std::string_view text, Load& load) {
    const auto sign = text.find('%');
    if (sign == std::string_view::npos) return false;
    const auto percent = within(parseNumber(text.substr(0, sign)), 0, 100);
    const std::string_view rest = trimmed(text.substr(sign + 1));
    if (!percent) return false;
    if (!rest.empty()) {
        const auto seed = within(parseNumber(after(rest, "seed")), 0, 1e9);
        if (!seed || *seed != std::floor(*seed)) return false;
        load.openSeed = static_cast<std::uint64_t>(*seed);
    }
    load.openFraction = *percent / 100;
    return true;
}

bool parseModifier(std::string_view text, Load& load) {
    if (const auto volts = after(text, "halves at "); !volts.empty()) {
        const auto value = within(parseQuantity(volts, "V"), 1e-3, 1e6);
        if (!value || load.kind != LoadKind::SkinEquivalent) return false;
        load.halvingVoltage = Volts(*value);
        return true;
    }
    if (auto rate = after(text, "drift "); !rate.empty()) {
        if (!rate.ends_with("%/s")) return false;
        rate.remove_suffix(3);
        const auto percent = within(parseNumber(rate), -100, 100);
        if (!percent) return false;
        load.driftPerSecond = *percent / 100;
        return true;
    }
    if (const auto window = after(text, "open "); !window.empty()) return parseWindow(window, load);
    if (const auto fraction = after(text, "intermittent "); !fraction.empty()) return parseIntermittent(fraction, load);
    return false;
}

/// Returns "10 kohm", with just enough digits to read the same number back.
std::string ohmText(Ohms r) {
    const double value = r.value();
    for (const auto& [scale, unit] : {std::pair{1e6, "Mohm"}, std::pair{1e3, "kohm"}}) {
        if (value >= scale) return fmt::format("{} {}", value / scale, unit);
    }
    return fmt::format("{} ohm", value);
}

/// Returns a uniform number in [0, 1) that depends only on the seed and the cell (splitmix64's finaliser), so that
/// contact at a moment does not depend on earlier queries.
double hashedUniform(std::uint64_t seed, std::uint64_t cell) noexcept {
    std::uint64_t z = seed * 0x9E3779B97F4A7C15ULL + (cell + 1) * 0xD1B54A32D192ED03ULL;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    z ^= z >> 31U;
    return static_cast<double>(z >> 11U) * 0x1p-53;
}

double inFarads(Nanofarads c) noexcept { return c.value() * 1e-9; }

/// Returns the largest |voltage| across the parallel resistance over `pulse`, starting from rest.
double largestCapacitorVoltage(const Circuit& circuit, std::span<const DriveSegment> pulse,
                               const SourceLimits& limits) noexcept {
    double largest = 0;
    double capacitor = 0;
    for (const auto& segment : pulse) {
        const auto response = respond(circuit, segment, capacitor, limits);
        // v − i·R_s is a curve of the same form, so its extremes lie at the ends of a piece or where its slope is zero.
        for (const auto& piece : response.pieces()) {
            ResponsePiece inner = piece;
            inner.v = {piece.v.a - piece.i.a * circuit.seriesOhm, piece.v.b - piece.i.b * circuit.seriesOhm,
                       piece.v.c - piece.i.c * circuit.seriesOhm};
            largest = std::max(largest, inner.peakVoltage());
        }
        capacitor = response.endCapacitorVoltage;
    }
    return largest;
}

}  // namespace

Load Load::resistor(Ohms r) noexcept {
    Load load;
    load.series = r;
    return load;
}

Load Load::skin(Ohms rs, Ohms rp, Nanofarads c) noexcept {
    Load load;
    load.kind = LoadKind::SkinEquivalent;
    load.series = rs;
    load.parallel = rp;
    load.capacitance = c;
    return load;
}

Load Load::openCircuit() noexcept {
    Load load;
    load.kind = LoadKind::Open;
    return load;
}

Load Load::shortCircuit() noexcept {
    Load load;
    load.kind = LoadKind::Short;
    load.series = Ohms(kShortOhms);
    return load;
}

bool Load::isOpenAt(double t_s) const noexcept {
    if (kind == LoadKind::Open) return true;
    for (std::size_t w = 0; w < windowCount; ++w) {
        if (t_s >= windows[w].from_s && t_s < windows[w].to_s) return true;
    }
    if (!(openFraction > 0) || !(t_s >= 0)) return false;
    return hashedUniform(openSeed, static_cast<std::uint64_t>(t_s / kContactCell_s)) < openFraction;
}

std::span<const NamedLoad> benchLoads() noexcept {
    static const std::array<NamedLoad, 9> kLoads{{
        {"100 ohm", Load::resistor(Ohms(100))},
        {"500 ohm", Load::resistor(Ohms(500))},
        {"1 kohm", Load::resistor(Ohms(1000))},
        {"2 kohm", Load::resistor(Ohms(2000))},
        {"10 kohm", Load::resistor(Ohms(10'000))},
        {"100 kohm", Load::resistor(Ohms(100'000))},
        {"open", Load::openCircuit()},
        {"short", Load::shortCircuit()},
        {"200 ohm + 10 kohm || 50 nF", benchRcLoad()},
    }};
    return kLoads;
}

Load benchRcLoad() noexcept { return Load::skin(Ohms(200), Ohms(10'000), Nanofarads(50)); }

Load scaled(const Load& load, double factor) noexcept {
    Load result = load;
    if (load.kind == LoadKind::Open || load.kind == LoadKind::Short) return result;
    result.series = load.series * factor;
    result.parallel = load.parallel * factor;
    result.capacitance = load.capacitance / factor;
    return result;
}

Circuit circuitAt(const Load& load, double t_s, std::span<const DriveSegment> pulse,
                  const SourceLimits& limits) noexcept {
    Circuit circuit;
    if (load.kind == LoadKind::Open) {
        circuit.seriesOhm = kShortOhms;
        circuit.open = true;
        return circuit;
    }
    if (load.kind == LoadKind::Short) {
        circuit.seriesOhm = kShortOhms;
        circuit.open = load.isOpenAt(t_s);
        return circuit;
    }
    const double drift = std::clamp(1 + load.driftPerSecond * t_s, 0.01, 100.0);
    // Drift stops at the resistance of a wire. A smaller series resistance, as at the end of a range, stays as it is,
    // because the worst case lies there (H1).
    circuit.seriesOhm = std::max(load.series.value() * drift, std::min(load.series.value(), kShortOhms));
    circuit.open = load.isOpenAt(t_s);
    if (load.kind == LoadKind::Resistor) return circuit;
    circuit.parallelOhm = load.parallel.value() * drift;
    circuit.capacitance_F = inFarads(load.capacitance);
    if (load.halvingVoltage.value() > 0 && !pulse.empty() && !circuit.open) {
        const double v = largestCapacitorVoltage(circuit, pulse, limits);
        circuit.parallelOhm /= 1 + v / load.halvingVoltage.value();
    }
    return circuit;
}

Ohms effectiveImpedance(const Load& load, const DriveSegment& leadingPhase, const SourceLimits& limits,
                        double t_s) noexcept {
    PulseResponse response(circuitAt(load, t_s, {&leadingPhase, 1}, limits), limits);
    response.add(leadingPhase, PulsePart::LeadingPhase);
    return Ohms(response.totals().impedanceOhm());
}

Result<Load> parseLoad(std::string_view text) {
    const auto parts = split(text, ',');
    auto load = parseCircuit(trimmed(parts.front()));
    for (std::size_t part = 1; load && part < parts.size(); ++part) {
        if (!parseModifier(trimmed(parts[part]), *load)) load.reset();
    }
    if (!load) return invalid("load \"{}\" is not {}", text, kAccepted);
    return *load;
}

std::string Load::text() const {
    std::string out;
    switch (kind) {
        case LoadKind::Open:
            out = "open";
            break;
        case LoadKind::Short:
            out = "short";
            break;
        case LoadKind::Resistor:
            out = ohmText(series);
            break;
        case LoadKind::SkinEquivalent:
            out = fmt::format("{} + {} || {} nF", ohmText(series), ohmText(parallel), capacitance.value());
            break;
    }
    if (halvingVoltage.value() > 0) out += fmt::format(", halves at {} V", halvingVoltage.value());
    if (driftPerSecond != 0) out += fmt::format(", drift {} %/s", driftPerSecond * 100);
    for (std::size_t w = 0; w < windowCount; ++w) {
        out += fmt::format(", open {} s to {} s", windows[w].from_s, windows[w].to_s);
    }
    if (openFraction > 0) out += fmt::format(", intermittent {} % seed {}", openFraction * 100, openSeed);
    return out;
}

}  // namespace tacto
