#include "core/bench/BenchNotes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/session/SessionWriter.h"

namespace tacto {

void BenchNotes::calibration(const KnownLines& applied, const std::string& text) const {
    if (session_ == nullptr || text.empty()) return;
    const StimulatorCalibration lines = applied.value_or(StimulatorCalibration{});
    const auto interval = lines.interval.value_or(CalibrationLine{}),
               width = lines.phaseWidth.value_or(CalibrationLine{}), gap = lines.gap.value_or(CalibrationLine{});
    static_cast<void>(session_->event(clock_.now(), "calibration",
                                      {{"gain", lines.amplitude.gain},
                                       {"offset", lines.amplitude.offset},
                                       {"interval_gain", interval.gain},
                                       {"interval_offset_s", interval.offset},
                                       {"width_gain", width.gain},
                                       {"width_offset_s", width.offset},
                                       {"gap_gain", gap.gain},
                                       {"gap_offset_s", gap.offset},
                                       {"text", text}}));
}

Result<void> BenchNotes::profile(const Profile& previous, const Profile& next) const {
    if (session_ == nullptr) return {};
    const auto before = toJson(previous), after = toJson(next);
    auto changed = nlohmann::json::array();
    for (const auto& [section, value] : after.items()) {
        const auto earlier = before.value(section, nlohmann::json());
        if (earlier == value) continue;
        if (!value.is_object() || !earlier.is_object()) {  // an electrode may be described only before or after
            changed.push_back(section);
            continue;
        }
        for (const auto& [key, part] : value.items())
            if (earlier.value(key, nlohmann::json()) != part) changed.push_back(fmt::format("{}.{}", section, key));
    }
    for (const auto& [section, value] : before.items())
        if (!after.contains(section)) changed.push_back(section);
    if (changed.empty()) return {};
    const auto noted = session_->event(clock_.now(), "settings", {{"changed", changed}, {"profile", after}});
    return noted ? Result<void>{} : failure(noted);
}

Result<void> BenchNotes::arming(const ArmRequest& request, const GateSetup& setup, const Profile& profile) const {
    if (session_ == nullptr) return {};
    auto limits = nlohmann::json::array();
    for (const auto& set : setup.limits) limits.push_back(set.id);
    const auto area = setup.electrodeArea;
    const auto written = toJson(profile);
    const auto noted = session_->event(clock_.now(), "arming",
                                       {{"load", request.load},
                                        {"load_least", setup.load.min.text()},
                                        {"load_most", setup.load.max.text()},
                                        {"electrode_area_cm2", area ? nlohmann::json(area->value()) : nlohmann::json()},
                                        {"electrode", written.value("electrode", nlohmann::json())},
                                        {"limits", limits},
                                        {"ceilings", written.at("safety").at("ceilings")},
                                        {"calibrated", setup.calibrated},
                                        {"mode", nameOf(setup.mode)},
                                        {"confirmed", request.confirmed}});
    return noted ? Result<void>{} : failure(noted);
}

Result<void> BenchNotes::level(const char* kind, const StimulusLevel& level, const StimulusLevel& ceiling) const {
    if (session_ == nullptr) return {};
    nlohmann::json said;
    for (const auto& [name, value] : {std::pair<std::string, StimulusLevel>{"level", level}, {"ceiling", ceiling}}) {
        if (const auto* current = std::get_if<Milliamps>(&value))
            said[name + "_ma"] = current->value();
        else
            said[name + "_intensity"] = std::get<VibrationIntensity>(value).value;
    }
    const auto noted = session_->event(clock_.now(), kind, said);
    return noted ? Result<void>{} : failure(noted);
}

void BenchNotes::marks(const RoughnessFlags& flags, std::optional<bool> calibrated,
                       const Profile& profile) const noexcept {
    if (session_ == nullptr) return;
    const auto& u = profile.roughness.uncertainty;
    const auto ofR = u ? nlohmann::json{u->expanded(0), u->expanded(0.5), u->expanded(1)} : nlohmann::json();
    const nlohmann::json marks{{"flags", flags.texts()},
                               {"stimulator_calibrated", calibrated ? nlohmann::json(*calibrated) : nlohmann::json()},
                               {"R_expanded_uncertainty", ofR}};
    static_cast<void>(session_->event(clock_.now(), kMarksEvent, marks));
}

}  // namespace tacto
