// RoughnessFlags.h - what limits R and P of one fingertip: the flags of science.md section 2, each with how often.
//
// Thread-safety: values. Trivially copyable, so that the control loop can publish them; only texts() allocates.
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
    ForceBelowContact,  ///< the range of force where it stays below contact
    // The flags from here on have a count:
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
[[nodiscard]] std::string_view nameOf(RoughnessFlag flag) noexcept;  // "sliding assumed"

struct RoughnessFlags {
    std::array<std::uint32_t, kRoughnessFlags> times{};  ///< how often each flag was given, by RoughnessFlag
    double leastForce = 0, mostForce = 0;                ///< the range of force where it stays below contact
    StreamUnit forceUnit = StreamUnit::Newton;           ///< their unit

    void raise(RoughnessFlag flag, bool given) noexcept { times[std::size_t(flag)] = given ? 1 : 0; }
    void count(RoughnessFlag flag, std::size_t number) noexcept {
        times[std::size_t(flag)] = static_cast<std::uint32_t>(number);
    }
    [[nodiscard]] bool has(RoughnessFlag flag) const noexcept { return times[std::size_t(flag)] > 0; }
    /// The larger count of each.
    void include(const RoughnessFlags& other) noexcept;
    /// Drops the flags that say something about the profile, and not about the samples.
    void dropCalibration() noexcept;
    /// Drops the flags that, so far, say why there is no contact, or that a stream has nothing.
    void dropAbsence() noexcept;
    /// The words of science.md: "sliding assumed"; with their count "gaps in acceleration: 2", with their range "force
    /// below contact: -1.2 to -0.8 N".
    [[nodiscard]] std::vector<std::string> texts() const;
};

/// The text of a flag, with its count where it has one, as a sentence for people: "The finger is taken to slide
/// whenever it touches: …". Any other text is returned as it is.
[[nodiscard]] std::string flagSentence(std::string_view text);

/// The last paragraph of science.md section 2. It stands wherever R is shown.
inline constexpr const char* kKnownLimitOfR =
    "Known limit of R: on the public sliding data tried so far its features are repeatable and specific to a material, "
    "but do not by themselves rank felt roughness; the reference surfaces give R its meaning.";

}  // namespace tacto
