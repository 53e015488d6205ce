#include "drivers/simulated/Surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/simulated/FastNoise.h"

namespace tacto::sim {

namespace {
// How skin touches a surface; lengths in metres.
constexpr double kPatch = 2e-3;            // contact length of a fingerprint ridge: asperities average out over it
constexpr double kCoherent = 0.5;          // share of a grating's motion that remains over several ridges
constexpr double kFollow = 100e-6;         // the fingertip bridges relief deeper than this
constexpr double kCorneum = 2e-6;          // the outer skin layer follows relief finer than this
constexpr double kTaxelCompliance = 8e-6;  // relief finer than this presses evenly on a taxel
constexpr double kRidge = 60e-6;           // contact length of one asperity with a ridge: a low-pass in space
constexpr double kTaxelSide = 5e-3;
constexpr double kBearingFraction = 0.05;  // share of the summits that carry the load
constexpr double kMaxUneven = 0.75;        // a taxel's pressure never falls to zero while the finger presses

double metres(Micrometres length) { return length.value() * 1e-6; }
double rms(Micrometres ra) { return metres(ra) * std::sqrt(std::numbers::pi / 2); }  // for a Gaussian profile

/// Runs a first-order recursion twice around the table, first to settle, so that the result repeats without a seam.
template <class Input>
void runAround(std::vector<float>& table, double keep, const Input& input) {
    double state = 0;
    const std::size_t settle = std::min(table.size(), static_cast<std::size_t>(30 / (1 - keep)) + 1);
    for (std::size_t i = table.size() - settle; i < table.size(); ++i) state = keep * state + input(i);
    for (std::size_t i = 0; i < table.size(); ++i) {
        state = keep * state + input(i);
        table[i] = static_cast<float>(state);
    }
}
}  // namespace

Surface::Surface(const Material& material, std::uint64_t seed)
    : material_(material), height_(kCells), contact_(kCells), bearing_(kBearingCells) {
    makeProfile(seed);
    makeContact();
    makeBearing(seed);
    const double rq = rms(material.ra);
    flicker_ = rq / (rq + kCorneum);
}

void Surface::makeProfile(std::uint64_t seed) {
    FastNoise noise(seed, material_.name);
    std::vector<float> white(kCells);
    for (auto& w : white) w = static_cast<float>(noise.normal());
    const double keep = std::exp(-kCell_m / metres(material_.correlationLength));
    runAround(height_, keep, [&](std::size_t i) { return static_cast<double>(white[i]); });
    double mean = 0;
    for (const float z : height_) mean += static_cast<double>(z);
    mean /= static_cast<double>(kCells);
    double deviation = 0;
    for (const float z : height_) deviation += std::abs(static_cast<double>(z) - mean);
    const double scale = metres(material_.ra) * static_cast<double>(kCells) / deviation;
    for (float& z : height_) z = static_cast<float>((static_cast<double>(z) - mean) * scale);
    gratingAmplitude_ = material_.gratingPeriod.value() > 0 ? metres(material_.gratingDepth) / 2 : 0;
    for (std::size_t i = 0; i < kCells; ++i) height_[i] += static_cast<float>(grating(i));
}

double Surface::grating(std::size_t i) const noexcept {
    if (gratingAmplitude_ <= 0) return 0;
    // Uses a whole number of waves, so that the path repeats without a seam.
    const double total = static_cast<double>(kCells) * kCell_m;
    const double waves = std::round(total / (material_.gratingPeriod.value() * 1e-3));
    const double turns = waves * static_cast<double>(i) / static_cast<double>(kCells);
    return gratingAmplitude_ * std::sin(2 * std::numbers::pi * turns);
}

void Surface::makeContact() {
    const double rq = rms(material_.ra);
    const double along = metres(material_.asperitySpacing) / kPatch;  // 1/sqrt(N) of N = (patch / spacing)²
    const double gain = std::min(1.0, along) * kFollow / (kFollow + rq);
    const double keep = std::exp(-kCell_m / kRidge);
    // Asperities average out over the patch; the ridges of a grating move the whole patch together.
    const double coherent = kCoherent * kFollow / (kFollow + gratingAmplitude_ / std::numbers::sqrt2) - gain;
    runAround(contact_, keep, [&](std::size_t i) {
        return (1 - keep) * (gain * static_cast<double>(height_[i]) + coherent * grating(i));
    });
}

void Surface::makeBearing(std::uint64_t seed) {
    // Under a taxel N summits carry the load, a Poisson number, so its pressure deviates by 1/sqrt(N), as far as the
    // relief is too deep for the skin over the array to even out. A taxel rests on a summit or bridges a valley, so the
    // deviation has a limit in both directions.
    const double spacing = metres(material_.asperitySpacing);
    const double rq = rms(material_.ra);
    const double summits = kBearingFraction * kTaxelSide * kTaxelSide / (spacing * spacing);
    const double amount = std::min(kMaxUneven, rq / (rq + kTaxelCompliance) / std::sqrt(summits));
    FastNoise noise(seed, "summits under taxels");
    std::vector<float> white(kBearingCells);
    for (auto& w : white) w = static_cast<float>(noise.normal());
    const double keep = std::exp(-kBearingCell_m / (kTaxelSide / 2));
    runAround(bearing_, keep, [&](std::size_t i) { return static_cast<double>(white[i]); });
    double square = 0;
    for (float& b : bearing_) {
        b = static_cast<float>(std::tanh(2.0 * static_cast<double>(b) * std::sqrt(1 - keep * keep)));
        square += static_cast<double>(b) * static_cast<double>(b);
    }
    const double scale = amount / std::sqrt(square / static_cast<double>(kBearingCells));
    for (float& b : bearing_) b = static_cast<float>(static_cast<double>(b) * scale);
}

Micrometres Surface::ra() const noexcept {
    double sum = 0;
    for (const float z : height_) sum += std::abs(static_cast<double>(z));
    return Micrometres(sum / static_cast<double>(kCells) * 1e6);
}

Micrometres Surface::rz() const noexcept {
    // Five consecutive sampling lengths of 8 mm, as ISO 4288 prescribes for Ra above 10 µm.
    constexpr std::size_t kSampling = 1600;
    double sum = 0;
    for (std::size_t k = 0; k < 5; ++k) {
        const auto begin = height_.begin() + static_cast<std::ptrdiff_t>(k * kSampling);
        const auto [low, high] = std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(kSampling));
        sum += static_cast<double>(*high - *low);
    }
    return Micrometres(sum / 5 * 1e6);
}

Millimetres Surface::length() const noexcept { return Millimetres(static_cast<double>(kCells) * kCell_m * 1e3); }

double Surface::bearing(std::size_t track, double x_m) const noexcept {
    // Neighbouring tracks read the table far apart, so that they are independent.
    constexpr auto kApart = kBearingCells / 8;
    const auto lateral = static_cast<double>(track * kApart + track * track * 37);
    return lookUp(bearing_, x_m / kBearingCell_m + lateral);
}

}  // namespace tacto::sim
