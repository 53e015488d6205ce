// RoughnessFlags.h - flags for what limits R and P of one fingertip (science.md section 2), each with a count.
//
// Thread-safety: plain values. Trivially copyable, so that the control loop can publish them; only texts() allocates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Stream.h"

namespace tacto {

enum class RoughnessFlag : std::uint8_t {
    BandTruncated,
    NoSpectralFeature,
    NotForceNormalised,
    ContactAssumed,
    SlidingAssumed,
    BaselineAssumed,
    UncalibratedR,
    UncalibratedUnits,
    AnotherFingertip,
    FingertipNotNamed,
    ScalesLeftAside,
    NoFrameInContact,
    ForceBelowContact,  ///< force stays below contact; has the range of force
    // The following flags have a count:
    ForceElsewhere,
    TaxelsElsewhere,
    ForceStale,
    ForceInvalid,
    ForceBeyond,
    ForceOrder,
    AccelerationGaps,
    AccelerationOrder,
    AccelerationInvalid,
    AccelerationBeyond,
    TaxelsInvalid,
    TaxelsBeyond,
    TaxelsOrder,
};
inline constexpr std::size_t kRoughnessFlags = 26;
[[nodiscard]] std::string_view nameOf(RoughnessFlag flag) noexcept;  // for example "sliding assumed"

struct RoughnessFlags {
    std::array<std::uint32_t, kRoughnessFlags> times{};  ///< count of each flag, in the order of RoughnessFlag
    double leastForce = 0, mostForce = 0;                ///< range of force that stays below contact
    StreamUnit forceUnit = StreamUnit::Newton;           ///< unit of this range

    void raise(RoughnessFlag flag, bool given) noexcept { times[std::size_t(flag)] = given ? 1 : 0; }
    void count(RoughnessFlag flag, std::size_t number) noexcept {
        times[std::size_t(flag)] = static_cast<std::uint32_t>(number);
    }
    [[nodiscard]] bool has(RoughnessFlag flag) const noexcept { return times[std::size_t(flag)] > 0; }
    /// Keeps the larger count of each flag.
    void include(const RoughnessFlags& other) noexcept;
    /// Removes the flags that concern the profile and not the samples.
    void dropCalibration() noexcept;
    /// Removes the flags that say why there is no contact so far, or that a stream has no data.
    void dropAbsence() noexcept;
    /// Returns the flags in the words of science.md: "sliding assumed"; with a count, "gaps in acceleration: 2"; with a
    /// range, "force below contact: -1.2 to -0.8 N".
    [[nodiscard]] std::vector<std::string> texts() const;
};

/// Returns the text of a flag, with its count if it has one, as a sentence for people: "The finger is taken to slide
/// whenever it touches: …". Any other text is returned unchanged.
[[nodiscard]] std::string flagSentence(std::string_view text);

/// The last paragraph of science.md section 2, shown wherever R is shown.
inline constexpr const char* kKnownLimitOfR =
    "Known limit of R: on the public sliding data tried so far its features are repeatable and specific to a material, "
    "but do not by themselves rank felt roughness; the reference surfaces give R its meaning.";

}  // namespace tacto
