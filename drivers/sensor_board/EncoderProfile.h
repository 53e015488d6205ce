// EncoderProfile.h - a laboratory's profile in the form that the board's own encoder takes
// (resources/firmware/tactile_encoder).
//
// Thread-safety: pure functions.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/dsp/RoughnessSettings.h"
#include "core/encoding/EncodingProfile.h"
#include "core/safety/GateSetup.h"
#include "resources/firmware/tactile_encoder/tactile_encoder.h"

namespace tacto {

/// What the board's stimulator is, and its load.
struct EncoderOutput {
    SourceTraits source;
    LoadRange load;  ///< resistors: a current source gets A / nominal
    Ceilings ceilings;
};

/// Returns what the encoder needs, with its hash. `streams` and `serial`: of the board's sensors, for which the
/// settings' scales hold or do not (StreamScaling). Errors: Unsupported, naming what the board cannot do: a load with a
/// capacitor, a held charge or energy, a ceiling that it does not judge, a width, gap or number of pulses that the
/// stimulator cannot set, more taxels or a faster stream than it has
/// memory for, or more than its own ceilings allow.
[[nodiscard]] Result<te_profile> encoderProfile(std::span<const StreamInfo> streams, const RoughnessSettings& roughness,
                                                const EncodingProfile& encoding, const EncoderOutput& output,
                                                std::string_view serial = {});

/// The profile for a board: the bytes that te_read_profile() reads, and a C header that defines `tactile_profile`.
/// `name`: of the laboratory's profile, for the header's comment.
[[nodiscard]] std::string profileBytes(const te_profile& profile);
[[nodiscard]] std::string profileHeader(const te_profile& profile, std::string_view name);

/// Returns why the encoder refuses, in words; empty for TE_ACCEPTED.
[[nodiscard]] std::string_view wordsOf(te_refusal refusal) noexcept;

/// Returns why no train comes, in words, from te_fault() and the refusal of a train that was due; empty if nothing
/// keeps trains back.
[[nodiscard]] std::string silenceWords(std::uint32_t faults, std::uint32_t refusal);

}  // namespace tacto
