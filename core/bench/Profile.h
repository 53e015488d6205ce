// Profile.h - all settings that a lab chooses for its fingertip, its encoding and its electrodes, in one JSON file.
//
//   {"name": "…", "roughness": {…}, "encoding": {…},
//    "safety": {"load_low_ohm": 500, "load_high_ohm": 10000, "electrode_area_cm2": 3,
//               "ceilings": {"peak_current": 20}},
//    "electrode": {"name": "…", "material": "…", "medium": "…"}}
//
// The tables of fields say what each key accepts: roughnessFields(), encodingFields(), profileFields(). A ceiling's key
// is a quantity of core/safety/LimitSet.h; its value is in that quantity's unit. A key that the file omits keeps the
// shipped value (resources/encodings/default.json). Only the limits on a step from train to train differ: a file that
// names none of them has none.
//
// Thread-safety: values; all functions are pure except those that read files.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/dsp/RoughnessSettings.h"
#include "core/encoding/EncodingProfile.h"
#include "core/safety/GateSetup.h"

namespace tacto {

/// What a laboratory calls its electrode; its area is Profile::electrodeArea. Recorded and reported; decides nothing.
struct ElectrodeDescription {
    std::string name;
    std::string material;  ///< "Ag/AgCl"
    std::string medium;    ///< between electrode and skin: "hydrogel"
    bool operator==(const ElectrodeDescription&) const = default;
};

struct Profile {
    std::string name = "default";
    RoughnessSettings roughness;
    EncodingProfile encoding;
    Ohms loadLow{500};  ///< with loadHigh: the range for previews, and for a person's |Z|
    Ohms loadHigh{10'000};
    std::optional<SquareCentimetres> electrodeArea;  ///< without this area, density rows are not evaluated
    std::optional<ElectrodeDescription> electrode;   ///< empty: not described
    Ceilings ceilings;
};

/// Every section and key, with the values that it accepts.
[[nodiscard]] const RecordFields<Profile>& profileFields();
/// Errors: ParseError naming an unknown key or a wrong type; InvalidArgument naming the field, its value and what is
/// accepted. `source` begins the error message for text that is not JSON.
[[nodiscard]] Result<Profile> parseProfile(std::string_view text, std::string_view source);
/// Errors: NotFound, Io; as parseProfile().
[[nodiscard]] Result<Profile> loadProfile(const std::filesystem::path& path);
/// Returns the whole profile, nothing left out; parsing this JSON gives the same profile.
[[nodiscard]] nlohmann::json toJson(const Profile& profile);

}  // namespace tacto
