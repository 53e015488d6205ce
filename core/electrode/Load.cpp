#include "core/electrode/Load.h"

#include <algorithm>
#include <cmath>

#include "core/electrode/LoadResponse.h"

namespace tacto {
namespace {

/// A uniform number in [0, 1) that depends on the seed and the cell alone (splitmix64's finaliser), so that contact at
/// a moment does not depend on which moments were asked about before.
double hashedUniform(std::uint64_t seed, std::uint64_t cell) noexcept {
    std::uint64_t z = seed * 0x9E3779B97F4A7C15ULL + (cell + 1) * 0xD1B54A32D192ED03ULL;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    z ^= z >> 31U;
    return static_cast<double>(z >> 11U) * 0x1p-53;
}

double inFarads(Nanofarads c) noexcept { return c.value() * 1e-9; }

/// The largest |voltage| across the parallel resistance over `pulse`, from rest.
double largestCapacitorVoltage(const Circuit& circuit, std::span<const DriveSegment> pulse,
                               const SourceLimits& limits) noexcept {
    double largest = 0;
    double capacitor = 0;
    for (const auto& segment : pulse) {
        const auto response = respond(circuit, segment, capacitor, limits);
        // v − i·R_s has its extremes at a piece's ends or where its slope is zero, as any curve of this form.
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
    circuit.seriesOhm = std::max(load.series.value() * drift, kShortOhms);
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

}  // namespace tacto
