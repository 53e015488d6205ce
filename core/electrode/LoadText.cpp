#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "core/base/Text.h"
#include "core/electrode/Load.h"

namespace tacto {
namespace {

constexpr std::string_view kAccepted =
    "a resistance (\"500 ohm\", \"10k\"), \"open\", \"short\" or \"200 ohm + 10 kohm || 50 nF\", then any of "
    "\", halves at 20 V\", \", drift 0.1 %/s\", \", open 1.5 s to 1.7 s\", \", intermittent 5 % seed 3\"";

std::optional<double> within(std::optional<double> value, double low, double high) {
    // The ends are meant with the last bits of unit conversion.
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
    if (!text.ends_with('F')) return std::nullopt;  // a bare number could be anything
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

/// "10 kohm": every digit that is needed to read the same number back, and no more.
std::string ohmText(Ohms r) {
    const double value = r.value();
    for (const auto& [scale, unit] : {std::pair{1e6, "Mohm"}, std::pair{1e3, "kohm"}}) {
        if (value >= scale) return fmt::format("{} {}", value / scale, unit);
    }
    return fmt::format("{} ohm", value);
}

}  // namespace

Result<Load> parseLoad(std::string_view text) {
    const auto parts = split(text, ',');
    auto load = parseCircuit(trimmed(parts.front()));
    for (std::size_t part = 1; load && part < parts.size(); ++part) {
        if (!parseModifier(trimmed(parts[part]), *load)) load.reset();
    }
    if (!load) return fail(ErrorCode::InvalidArgument, "load \"{}\" is not {}", text, kAccepted);
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
