// ResultKind.h - the declared properties of a kind of results. core/kinds lists all kinds.
#pragma once

#include <string_view>
#include <vector>

#include "core/results/ResultTable.h"

namespace tacto {

/// Kinds of results that the program itself treats specially.
enum class ResultKind {
    Other,  ///< a laboratory's own kind, a kind with only a table and a verdict, or no kind
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
    std::string_view name = {};          ///< "separability"; empty if the kind is not declared
    std::string_view decisionRule = {};  ///< used if the results state none; empty: the script's reasons state it
    bool guardBanded = false;            ///< true if the uncertainty counts against the device
    bool ofStudy = false;                ///< true for a session of a study, kept in its participant's record
    std::string_view procedure = {};     ///< usual name if it differs from `name`: "safety check"
    std::vector<std::string> members{};  ///< keys of the analysis' own record; empty if a protocol makes the record
    std::vector<ResultTable> tables{};   ///< in reading order
};

}  // namespace tacto
