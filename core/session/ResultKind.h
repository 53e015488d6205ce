// ResultKind.h - what results are, as their `kind` says it, and what is declared of each kind. The one place that
// compares names of kinds: tables of the app (how a kind is printed, tabulated, shown while it comes) go by ResultKind.
//
// Thread-safety: constant.
#pragma once

#include <optional>
#include <string_view>

namespace tacto {

enum class ResultKind {
    Other,  ///< a laboratory's own, or none
    Separability,
    EncodingComparison,
    Transitions,
    Variation,
    LoadSafety,
    StimulatorCalibration,
    SensorCalibration,
    Live,
    Massager,
    PilotThresholds,
    PilotIdentification
};

/// What a window draws while a run's rows come.
enum class ProtocolView {
    Trials,       ///< trains as captured
    Loads,        ///< a row per load of the bench set
    Calibration,  ///< measured against commanded
    Slides,       ///< a fingertip by itself
    None,
};

/// Where a pass leads.
enum class AfterPass { Nothing, SafetyCheck, Live };

struct ResultTraits {
    ResultKind kind = ResultKind::Other;
    std::string_view name = {};             ///< "separability"; empty for Other
    std::string_view decisionRule = {};     ///< where the results state none; empty: as the script says in its reasons
    bool guardBanded = false;               ///< the uncertainty stands on the side of the limit
    std::optional<ProtocolView> view = {};  ///< of protocols that declare none; nothing: their devices say it
    AfterPass afterPass = AfterPass::Nothing;
    bool ofStudy = false;             ///< a session of a study: with a participant, on their record
    std::string_view procedure = {};  ///< what people call it, where that is not its name: "safety check"
};

/// The traits of the kind with that name; those of Other where there is none.
[[nodiscard]] const ResultTraits& resultTraits(std::string_view name) noexcept;

}  // namespace tacto
