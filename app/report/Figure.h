// Figure.h - the figures that a protocol can put into a report: the JSON that describes each, and its parsed form.
//
// A script's `plot.*` builds this JSON, the session stores it, and the report draws it. It holds what a script has
// anyway (trials, found conditions, captures), but nothing about its appearance. Unknown keys are ignored, so a script
// may pass an entire result. Numbers are in the SI unit of the key's suffix; a null or missing number means "not known"
// and is drawn as a gap or stated in words, never as 0.
//
// A *statistic* is {"mean", "sd", "median", "min", "max", "n"} (only mean is required); an *estimate* is
// {"value", "low", "high"} (95 %, low and high optional). Condition names: "smooth-low", "smooth-high",
// "rough-low", "rough-high" (texture-pressure); others are drawn too, in further colours.
//
//   {"type": "conditions",                      the paper's figure: texture alone, pressure alone, the two combined
//    "conditions": [{"name": "smooth-low",
//                    "amplitude_v": statistic,  measured
//                    "interval_s": statistic,   measured, onset to onset of trains
//                    "n": 25,                   optional; default: amplitude_v.n
//                    "letter": "A",             "letter", "trains" and "pulse" are optional: the captured trains one
//                    "trains": [{"onset_s": 0, "low_v": -10.1, "high_v": 10.1}],   after the other, and the first pulse
//                    "pulse": {"rate_hz": 1e6, "start_s": -1e-4, "voltage_v": [..]}}]}
//
//   {"type": "plane",                           feature scatter with centroids and 95 % ellipses
//    "trials": [{"condition": "smooth-low", "amplitude_v": 10.0, "interval_s": 2.0}]}
//
//   {"type": "waveforms",                       small multiples, one per entry: voltage and current against time
//    "captures": [{"condition": "smooth-low",   or "label": any text; both optional
//                  "capture": 17,               a capture of the session by its id ... or the samples themselves:
//                  "rate_hz": 1e6, "start_s": -1e-4,   time of the first sample, usually against the trigger
//                  "voltage_v": [..], "current_a": [..]}]}   one may be missing, else equally long
//
//   {"type": "confusion",                       counts; a row per true condition, a column per answer
//    "labels": ["smooth-low", ..],              of the rows
//    "columns": [..],                           default: labels; may add answers such as "none" and "not sure"
//    "confusion": [[25, 0, 0, 0], ..],          "matrix" is taken too
//    "accuracy": estimate or number}            optional
//
//   {"type": "exposure",                        each row against its limit
//    "rows": [{"name": "RMS current, 5 s",      "quantity" is taken too
//              "value": 2.1, "limit": 10,       same unit; value null = not evaluated (drawn hatched)
//              "unit": "mA", "source": "paper", optional
//              "within": true,                  optional: the verdict; a value equal to the limit may fail ("<")
//              "warning": false,                optional: exceeding the limit is a warning, not a fault
//              "reason": "no electrode area"}]} optional, shown when not evaluated
//
//   {"type": "timeline",                        a live run over time
//    "t_s": [..], "r": [..], "p": [..],         equally long; r, p and amplitude_v optional, null = absent
//    "amplitude_v": [..],                       encoded amplitude
//    "trains": [{"t_s": 0.5, "amplitude_v": 22.0, "refused": false}],   optional
//    "faults": [{"t_s": 3.2, "text": "electrode open"}]}                optional
//
//   {"type": "calibration",                     from analysis.calibration()
//    "view": "measured",                        or "errors"; drawn against the command
//    "quantity": "amplitude", "unit": "V",      of everything below
//    "gain": 1.01, "offset": 0.2,               of the fitted line
//    "levels": [{"commanded": 10, "mean_up": .., "mean_down": .., "error": .., "expanded_uncertainty": ..,
//                "tolerance": ..}],
//    "readings": [{"commanded": 10, "measured": 10.3, "direction": "up", "outlier": false}]}
//
//   {"type": "transitions",                     from analysis.transitions(), by plot.transitions()
//    "wanted_jnd": 2,                           the largest step per train that is accepted
//    "amplitude": [[0.5, null], ..],            just-noticeable differences, rows of P by columns of R, both from 0 to
//    "interval": [[..], ..],                    1 inclusive; square, the same size; null = no train went there
//    "largest_amplitude": {"roughness": 0.4, "pressure": 0, "jnd": 8.3},   optional: where the worst step is
//    "largest_interval": {..}}
//
//   {"type": "curves",                          curves over one pair of axes, from plot.curves() and predictions
//    "x": {"label": "Trials", "unit": "",
//          "names": ["1", "2"]},               optional: texts in place of the numbers 1, 2, ...
//    "y": {"label": "Width", "unit": "%"},
//    "curves": [{"label": "one participant",
//                "x": [8, 16, ..], "y": [..],   equally long; null = a gap
//                "low": [..], "high": [..],     optional, drawn as a band, or as bars of points
//                "steps": true,                 optional: holds its value until the next point
//                "points": true,                optional: points without a line
//                "open": true,                  optional: points that are not filled
//                "n": [..]}],                   optional: trials of each point; more of them are a larger point
//    "lines": [{"label": "wanted", "y": 10}]}   optional, level
//
// Every type takes an optional "note": one sentence printed below the caption.
#pragma once

#include <QJsonObject>
#include <QString>
#include <QStringList>
#include <functional>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Statistic {
    double mean = kUnknown;
    double sd = kUnknown;
    double median = kUnknown;
    double min = kUnknown;
    double max = kUnknown;
    double n = kUnknown;
};

struct ConditionsFigure {
    struct Condition {
        QString name;
        Statistic amplitude_v;
        Statistic interval_s;
        double n = kUnknown;
        struct Train {
            double onset_s = kUnknown;  ///< relative to the onset of the first train
            double low_v = kUnknown;    ///< extremes of the train's record
            double high_v = kUnknown;
        };
        QString letter;
        std::vector<Train> trains;
        double pulseRate_hz = kUnknown;
        double pulseStart_s = 0;
        std::vector<double> pulse_v;
    };
    std::vector<Condition> conditions;
    /// True if at least one condition contains its trains.
    [[nodiscard]] bool captured() const;
};

struct PlaneFigure {
    struct Trial {
        QString condition;
        double amplitude_v = kUnknown;
        double interval_s = kUnknown;
    };
    std::vector<Trial> trials;
};

struct WaveformsFigure {
    struct Trace {
        QString condition;  ///< may be empty
        QString label;      ///< the text above the plot; by default the condition
        std::optional<qint64> capture;
        double rate_hz = kUnknown;
        double start_s = 0;
        std::vector<double> voltage_v;
        std::vector<double> current_a;
    };
    std::vector<Trace> captures;
};

struct ConfusionFigure {
    QStringList labels;
    QStringList columns;
    QString answers = "found";                ///< title of the columns
    std::vector<std::vector<double>> counts;  ///< labels.size() rows of columns.size()
    Estimate accuracy;
};

struct ExposureFigure {
    struct Row {
        QString name;
        double value = kUnknown;  ///< not finite: not evaluated
        double limit = kUnknown;
        QString unit;
        QString source;
        QString reason;
        bool warning = false;
        std::optional<bool> within = {};

        [[nodiscard]] bool evaluated() const;  ///< true if there is a value
        [[nodiscard]] bool over() const;       ///< true if evaluated and not within the limit
    };
    std::vector<Row> rows;
};

struct TimelineFigure {
    struct Train {
        double t_s = kUnknown;
        double amplitude_v = kUnknown;
        bool refused = false;
    };
    struct Fault {
        double t_s = kUnknown;
        QString text;
    };
    std::vector<double> t_s, r, p, amplitude_v;
    std::vector<Train> trains;
    std::vector<Fault> faults;
};

struct CalibrationFigure {
    struct Level {
        double commanded = kUnknown;
        double meanUp = kUnknown;
        double meanDown = kUnknown;
        double error = kUnknown;
        double uncertainty = kUnknown;  ///< expanded, 95 %
        double tolerance = kUnknown;    ///< half-width
    };
    struct Reading {
        double commanded = kUnknown;
        double measured = kUnknown;
        QString direction;  ///< "up", "down" or empty
        bool outlier = false;
    };
    QString quantity;
    QString unit;
    bool errors = false;  ///< true: errors against the command; false: measured values
    double gain = kUnknown;
    double offset = kUnknown;
    std::vector<Level> levels;
    std::vector<Reading> readings;
};

struct TransitionsFigure {
    struct Place {
        double roughness = kUnknown;
        double pressure = kUnknown;
        double jnd = kUnknown;
    };
    struct Map {
        std::vector<std::vector<double>> cells;  ///< [P][R], square
        Place largest;
    };
    double wanted_jnd = kUnknown;
    Map amplitude;
    Map interval;
};

struct CurvesFigure {
    struct Axis {
        QString label = {};
        QString unit = {};
        QStringList names = {};  ///< texts at 1, 2, ...; empty: numbers
    };
    struct Curve {
        QString label = {};
        std::vector<double> x = {}, y = {}, low = {}, high = {};  ///< as long as x, low and high may be empty
        bool steps = false;
        bool points = false;         ///< points without a line; low and high are bars
        bool open = false;           ///< points that are not filled
        std::vector<double> n = {};  ///< trials of each point; empty: points of one size
    };
    struct Line {
        QString label;
        double y = kUnknown;
    };
    Axis x, y;
    std::vector<Curve> curves;
    std::vector<Line> lines;
};

struct Figure {
    std::variant<ConditionsFigure, PlaneFigure, WaveformsFigure, ConfusionFigure, ExposureFigure, TimelineFigure,
                 CalibrationFigure, TransitionsFigure, CurvesFigure>
        content;
    QString note;
};

/// Checks `json` against the format above.
/// Errors: InvalidArgument naming the figure's type, the key and the expected value. Empty lists and unknown numbers
/// are not errors: the figure then says what is missing.
[[nodiscard]] Result<Figure> parseFigure(const QJsonObject& json);

/// Finds a session's capture by its id.
using CaptureLookup = std::function<Result<Capture>(qint64 id)>;

/// Fills in the samples of every waveform that names a capture by id, from its first channel in V and its first in A.
/// Waveforms with their own samples, and other figures, do not change.
/// Errors: those of `lookup`.
[[nodiscard]] Result<void> resolveCaptures(Figure& figure, const CaptureLookup& lookup);

}  // namespace tacto
