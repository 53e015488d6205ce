// Profile.h - everything a lab sets for its fingertip, its encoding and its electrodes: one JSON file.
//
//   {"name": "…", "roughness": {…}, "encoding": {…},
//    "safety": {"load_low_ohm": 500, "load_high_ohm": 10000, "electrode_area_cm2": 3,
//               "ceilings": {"peak_current": 20}}}
//
// The tables of fields say what each key accepts: roughnessFields(), encodingFields(), profileFields(). A ceiling's key
// is a quantity of core/safety/LimitSet.h, its value in that quantity's unit. What a file leaves out keeps the shipped
// value (resources/encodings/default.json), but for the limits on a step from train to train: a file that names none
// has none.
//
// Thread-safety: values; pure functions but for reading files.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/dsp/RoughnessSettings.h"
#include "core/encoding/EncodingProfile.h"
#include "core/safety/GateSetup.h"

namespace tacto {

struct Profile {
    std::string name = "default";
    RoughnessSettings roughness;
    EncodingProfile encoding;
    Ohms loadLow{500};  ///< previews, and the range in which a person's |Z| must lie
    Ohms loadHigh{10'000};
    std::optional<SquareCentimetres> electrodeArea;  ///< without it density rows are not evaluated
    Ceilings ceilings;
};

/// Every section and key, with the values that it accepts.
[[nodiscard]] const RecordFields<Profile>& profileFields();
/// Errors: ParseError naming an unknown key or a wrong type; InvalidArgument naming the field, its value and what is
/// accepted. `source` begins the message of text that is not JSON.
[[nodiscard]] Result<Profile> parseProfile(std::string_view text, std::string_view source);
/// Errors: NotFound, Io; as parseProfile().
[[nodiscard]] Result<Profile> loadProfile(const std::filesystem::path& path);
/// The whole profile, nothing left out; reads back to the same.
[[nodiscard]] nlohmann::json toJson(const Profile& profile);

}  // namespace tacto
