// ResultKind.h - what results are, as their `kind` says it, and what is declared of each kind. The one place that
// compares names of kinds: what the app does by kind goes by ResultKind.
//
// A kind is declared in one of the files beside this one, in a family of kinds that ResultKind.cpp lists.
#pragma once

#include <string_view>
#include <vector>

#include "core/results/ResultTable.h"

namespace tacto {

/// Kinds for which the program does something by itself.
enum class ResultKind {
    Other,  ///< a laboratory's own, one that is a table and a verdict and no more, or none
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

struct ResultTraits {
    ResultKind kind = ResultKind::Other;
    std::string_view name = {};          ///< "separability"; empty where results have no declared kind
    std::string_view decisionRule = {};  ///< where the results state none; empty: as the script says in its reasons
    bool guardBanded = false;            ///< judged with the uncertainty counting against the device
    bool ofStudy = false;                ///< a session of a study: with a participant, on their record
    std::string_view procedure = {};     ///< what people call it, where that is not its name: "safety check"
    std::vector<ResultTable> tables{};   ///< in the order in which they are read
};

/// The traits of the kind with that name; those of Other where there is none.
[[nodiscard]] const ResultTraits& resultTraits(std::string_view name);

/// What a report keeps of results: what the tables of their kind show, with the kind. Null where it has none.
[[nodiscard]] nlohmann::json shownInReports(const nlohmann::json& results);

}  // namespace tacto
