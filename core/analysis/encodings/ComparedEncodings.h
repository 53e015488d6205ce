// ComparedEncodings.h - compares assignments and curves of the encoding by what was measured under each (science.md
// section 4). Distances are in just-noticeable differences; NaN: a value was not measured or does not exist.
//
// Exchanging R and P is a symmetry of these distances, so no figure here can prefer one assignment to the other.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/analysis/separability/Separability.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// A place of the R-P plane to be presented under each encoding.
struct ComparedPlace {
    std::string name;
    double roughness = 0, pressure = 0;  ///< 0 to 1
};
inline constexpr std::size_t kComparedConditions = 4;
inline constexpr double kComparedAtLeast_jnd = 0.01;  ///< smaller differences are treated as none
/// Smooth-low, smooth-high, rough-low and rough-high.
[[nodiscard]] std::vector<ComparedPlace> comparedConditions(double low, double high);
/// R and P values of the levels between the conditions.
inline constexpr std::array kComparedLevels{0.25, 0.5, 0.75};
[[nodiscard]] std::vector<ComparedPlace> comparedLevels();

/// The names of an encoding, in the words of a profile.
struct EncodingName {
    std::string name, assignment, curve;
};

/// Neighbouring levels differ by one step in roughness or in pressure.
struct NeighbourDistances {
    double textureMin = 0, textureMean = 0;
    double pressureMin = 0, pressureMean = 0;
    double min = 0, mean = 0;
};

struct ComparedEncoding {
    EncodingName of;
    Separability conditions;  ///< of comparedConditions()
    Separability levels;      ///< of comparedLevels()
    double gradual_jnd = 0;   ///< largest computed step from train to train, as is `abrupt_jnd`
    double abrupt_jnd = 0;
    double smallestAmplitude_jnd = 0;  ///< of the pairs of conditions that differ in it, as is the interval
    double smallestInterval_jnd = 0;
    double smallestPair_jnd = 0;  ///< each pair counts on the axis that separates it best
    NeighbourDistances neighbours;
};
[[nodiscard]] ComparedEncoding comparedEncoding(EncodingName of, Separability conditions, Separability levels,
                                                double gradual_jnd, double abrupt_jnd);

/// What an encoding changes against the default. Negative: smaller.
struct EncodingDifference {
    struct Moved {
        double amplitude_jnd = 0, interval_jnd = 0;
    };
    std::string encoding;
    std::vector<Moved> conditions;  ///< in the order of comparedConditions()
    double pair_jnd = 0, neighboursMin_jnd = 0, neighboursMean_jnd = 0, perTrain_jnd = 0;
};

struct ComparedEncodings {
    std::vector<ComparedEncoding> encodings;      ///< the first is the default
    std::vector<EncodingDifference> differences;  ///< of the others from the default
    /// How far the two assignments of a curve differ as measured, after R and P are exchanged: the largest difference
    /// of all distances and conditions. NaN until both assignments of a curve were measured.
    double asymmetry_jnd = 0;
    std::vector<std::string> missing;  ///< a sentence for each encoding of which something was not measured
    std::string symmetry, farthest;    ///< what the figures mean, and which curve keeps what apart, as sentences
};
[[nodiscard]] ComparedEncodings compareEncodings(std::vector<ComparedEncoding> encodings);

/// The same sentence as `symmetry`, also before something was measured (NaN).
[[nodiscard]] std::string symmetryOfEncodings(double asymmetry_jnd);
/// States what is the same for all encodings.
[[nodiscard]] std::string sameForAllEncodings(const ComparedEncodings& compared);

/// The verdict is null unless something was not measured.
[[nodiscard]] nlohmann::json toJson(const ComparedEncodings& compared);
/// Describes how a comparison is shown.
[[nodiscard]] ResultTraits comparedEncodingsKind();

}  // namespace tacto
