#include "app/report/Figure.h"

#include <QJsonArray>
#include <array>
#include <cmath>

#include "app/report/NumberText.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

/// Reads the members of an object and remembers the first error.
class Reader {
public:
    Reader(QString where, QJsonObject object) : where_(std::move(where)), object_(std::move(object)) {}

    [[nodiscard]] bool has(const char* key) const {
        const auto value = object_.value(QLatin1String(key));
        return !value.isUndefined() && !value.isNull();
    }

    QString text(const char* key) {
        if (!has(key)) return {};
        const auto value = object_.value(QLatin1String(key));
        if (!value.isString()) complain(key, "a text");
        return shownText(value.toString());
    }

    bool flag(const char* key) {
        if (!has(key)) return false;
        const auto value = object_.value(QLatin1String(key));
        if (!value.isBool()) complain(key, "true or false");
        return value.toBool();
    }

    double number(const char* key, double absent = kUnknown) {
        if (!has(key)) return absent;
        const auto value = object_.value(QLatin1String(key));
        if (!value.isDouble()) complain(key, "a number");
        return value.toDouble(kUnknown);
    }

    Statistic statistic(const char* key) {
        if (!has(key)) return {};
        const auto value = object_.value(QLatin1String(key));
        if (value.isDouble()) return {.mean = value.toDouble()};
        if (!value.isObject()) {
            complain(key, "a number or {mean, sd, median, min, max, n}");
            return {};
        }
        Reader inner(where_ + "." + key, value.toObject());
        const Statistic result{inner.number("mean"), inner.number("sd"),  inner.number("median"),
                               inner.number("min"),  inner.number("max"), inner.number("n")};
        adopt(inner);
        return result;
    }

    Estimate estimate(const char* key) {
        if (!has(key)) return {};
        const auto value = object_.value(QLatin1String(key));
        if (value.isDouble()) return {.value = value.toDouble()};
        if (!value.isObject()) {
            complain(key, "a number or {value, low, high}");
            return {};
        }
        Reader inner(where_ + "." + key, value.toObject());
        const Estimate result{inner.number("value"), inner.number("low"), inner.number("high")};
        adopt(inner);
        return result;
    }

    std::vector<double> numbers(const char* key) {
        std::vector<double> result;
        if (!has(key)) return result;
        const auto value = object_.value(QLatin1String(key));
        if (!value.isArray()) {
            complain(key, "a list of numbers");
            return result;
        }
        const auto array = value.toArray();
        result.reserve(static_cast<std::size_t>(array.size()));
        for (const auto& element : array) {
            if (!element.isDouble() && !element.isNull()) complain(key, "a list of numbers or null");
            result.push_back(element.toDouble(kUnknown));
        }
        return result;
    }

    QStringList texts(const char* key) {
        QStringList result;
        if (!has(key)) return result;
        const auto value = object_.value(QLatin1String(key));
        if (!value.isArray()) complain(key, "a list of texts");
        for (const auto& element : value.toArray()) {
            if (!element.isString()) complain(key, "a list of texts");
            result << shownText(element.toString());
        }
        return result;
    }

    /// Calls `each(Reader&)` for every object of the list `key`; an error if the list is `required` and missing.
    template <class Each>
    void objects(const char* key, bool required, Each each) {
        if (!has(key)) {
            if (required) complain(key, "a list");
            return;
        }
        const auto value = object_.value(QLatin1String(key));
        if (!value.isArray()) {
            complain(key, "a list of objects");
            return;
        }
        int index = 0;
        for (const auto& element : value.toArray()) {
            const QString place = QString("%1.%2[%3]").arg(where_, key).arg(index++);
            if (!element.isObject()) complain(key, "a list of objects");
            Reader inner(place, element.toObject());
            each(inner);
            adopt(inner);
        }
    }

    /// Calls `read(Reader&)` for the object `key`, which may be missing.
    template <class Read>
    void object(const char* key, Read read) {
        if (!has(key)) return;
        const auto value = object_.value(QLatin1String(key));
        if (!value.isObject()) complain(key, "an object");
        Reader inner(where_ + "." + key, value.toObject());
        read(inner);
        adopt(inner);
    }

    [[nodiscard]] QJsonArray list(const char* key) const { return object_.value(QLatin1String(key)).toArray(); }

    void complain(const char* key, const char* expected) {
        if (!problem_.isEmpty()) return;
        problem_ = QString("%1: \"%2\" must be %3.").arg(where_, key, expected);
    }
    void adopt(const Reader& inner) {
        if (problem_.isEmpty()) problem_ = inner.problem_;
    }
    [[nodiscard]] const QString& problem() const { return problem_; }

private:
    QString where_;
    QJsonObject object_;
    QString problem_;
};

ConditionsFigure readConditions(Reader& in) {
    ConditionsFigure figure;
    in.objects("conditions", true, [&](Reader& item) {
        ConditionsFigure::Condition condition;
        condition.name = item.text("name");
        condition.amplitude_v = item.statistic("amplitude_v");
        condition.interval_s = item.statistic("interval_s");
        condition.n = item.number("n", condition.amplitude_v.n);
        condition.letter = item.text("letter").left(2);
        item.objects("trains", false, [&](Reader& train) {
            condition.trains.push_back({train.number("onset_s"), train.number("low_v"), train.number("high_v")});
        });
        item.object("pulse", [&](Reader& pulse) {
            condition.pulseRate_hz = pulse.number("rate_hz");
            condition.pulseStart_s = pulse.number("start_s", 0);
            condition.pulse_v = pulse.numbers("voltage_v");
        });
        figure.conditions.push_back(std::move(condition));
    });
    return figure;
}

PlaneFigure readPlane(Reader& in) {
    PlaneFigure figure;
    in.objects("trials", true, [&](Reader& item) {
        figure.trials.push_back({item.text("condition"), item.number("amplitude_v"), item.number("interval_s")});
    });
    return figure;
}

WaveformsFigure readWaveforms(Reader& in) {
    WaveformsFigure figure;
    in.objects("captures", true, [&](Reader& item) {
        WaveformsFigure::Trace trace;
        trace.condition = item.text("condition");
        trace.label = item.text("label");
        if (trace.label.isEmpty()) trace.label = trace.condition;
        if (item.has("capture")) trace.capture = static_cast<qint64>(item.number("capture", -1));
        trace.rate_hz = item.number("rate_hz");
        trace.start_s = item.number("start_s", 0);
        trace.voltage_v = item.numbers("voltage_v");
        trace.current_a = item.numbers("current_a");
        const bool inlineSamples = !trace.voltage_v.empty() || !trace.current_a.empty();
        if (inlineSamples && !(trace.rate_hz > 0 && std::isfinite(trace.rate_hz))) {
            item.complain("rate_hz", "a number above 0 where samples are given");
        }
        if (!trace.voltage_v.empty() && !trace.current_a.empty() && trace.voltage_v.size() != trace.current_a.size()) {
            item.complain("current_a", "as long as \"voltage_v\"");
        }
        figure.captures.push_back(std::move(trace));
    });
    return figure;
}

ConfusionFigure readConfusion(Reader& in) {
    ConfusionFigure figure;
    figure.labels = in.texts("labels");
    figure.columns = in.has("columns") ? in.texts("columns") : figure.labels;
    figure.accuracy = in.estimate("accuracy");
    const char* key = in.has("confusion") ? "confusion" : "matrix";
    if (!in.has(key)) in.complain("confusion", "a list of rows of counts");
    for (const auto& row : in.list(key)) {
        std::vector<double> counts;
        for (const auto& cell : row.toArray()) {
            if (!cell.isDouble() || !(cell.toDouble() >= 0)) in.complain(key, "rows of counts, 0 or more");
            counts.push_back(cell.toDouble());
        }
        if (static_cast<qsizetype>(counts.size()) != figure.columns.size()) {
            in.complain(key, "rows as long as there are columns");
        }
        figure.counts.push_back(std::move(counts));
    }
    if (static_cast<qsizetype>(figure.counts.size()) != figure.labels.size()) {
        in.complain(key, "one row per label");
    }
    return figure;
}

ExposureFigure readExposure(Reader& in) {
    ExposureFigure figure;
    in.objects("rows", true, [&](Reader& item) {
        ExposureFigure::Row row;
        row.name = item.has("name") ? item.text("name") : item.text("quantity");
        row.value = item.number("value");
        row.limit = item.number("limit");
        row.unit = item.text("unit");
        row.source = item.text("source");
        row.reason = item.text("reason");
        row.warning = item.flag("warning");
        if (item.has("within")) row.within = item.flag("within");
        if (const double measured = item.number("measured"); row.evaluated() && std::isfinite(measured)) {
            row.reason = "measured " + quantityText(measured, row.unit, 3);
            if (item.flag("measured_beyond")) row.reason += " (beyond accuracy)";
        }
        if (row.name.isEmpty()) item.complain("name", "the name of the limited quantity");
        figure.rows.push_back(std::move(row));
    });
    return figure;
}

TimelineFigure readTimeline(Reader& in) {
    TimelineFigure figure;
    figure.t_s = in.numbers("t_s");
    figure.r = in.numbers("r");
    figure.p = in.numbers("p");
    figure.amplitude_v = in.numbers("amplitude_v");
    const std::array<std::pair<const char*, const std::vector<double>*>, 3> series{
        {{"r", &figure.r}, {"p", &figure.p}, {"amplitude_v", &figure.amplitude_v}}};
    for (const auto& [key, values] : series) {
        if (!values->empty() && values->size() != figure.t_s.size()) in.complain(key, "as long as \"t_s\"");
    }
    in.objects("trains", false, [&](Reader& item) {
        figure.trains.push_back({item.number("t_s"), item.number("amplitude_v"), item.flag("refused")});
    });
    in.objects("faults", false, [&](Reader& item) {
        figure.faults.push_back({item.number("t_s"), item.text("text")});
    });
    return figure;
}

CalibrationFigure readCalibration(Reader& in) {
    CalibrationFigure figure;
    const QString view = in.text("view");
    if (view != "measured" && view != "errors") in.complain("view", "measured or errors");
    figure.errors = view == "errors";
    figure.quantity = in.text("quantity");
    figure.unit = in.text("unit");
    figure.gain = in.number("gain");
    figure.offset = in.number("offset");
    in.objects("levels", true, [&](Reader& item) {
        figure.levels.push_back({item.number("commanded"), item.number("mean_up"), item.number("mean_down"),
                                 item.number("error"), item.number("expanded_uncertainty"), item.number("tolerance")});
    });
    in.objects("readings", true, [&](Reader& item) {
        figure.readings.push_back(
            {item.number("commanded"), item.number("measured"), item.text("direction"), item.flag("outlier")});
    });
    return figure;
}

TransitionsFigure::Map readMap(Reader& in, const char* key, const char* largest) {
    TransitionsFigure::Map map;
    if (!in.has(key)) in.complain(key, "rows of numbers or null");
    const auto rows = in.list(key);
    for (const auto& row : rows) {
        std::vector<double> cells;
        for (const auto& cell : row.toArray()) cells.push_back(cell.toDouble(kUnknown));
        if (static_cast<qsizetype>(cells.size()) != rows.size()) in.complain(key, "as many columns as rows");
        map.cells.push_back(std::move(cells));
    }
    in.object(largest, [&](Reader& place) {
        map.largest = {place.number("roughness"), place.number("pressure"), place.number("jnd")};
    });
    return map;
}

TransitionsFigure readTransitions(Reader& in) {
    TransitionsFigure figure;
    figure.wanted_jnd = in.number("wanted_jnd");
    if (!(figure.wanted_jnd > 0)) in.complain("wanted_jnd", "a number above 0");
    figure.amplitude = readMap(in, "amplitude", "largest_amplitude");
    figure.interval = readMap(in, "interval", "largest_interval");
    return figure;
}

CurvesFigure readCurves(Reader& in) {
    CurvesFigure figure;
    in.object("x", [&](Reader& axis) { figure.x = {axis.text("label"), axis.text("unit"), axis.texts("names")}; });
    in.object("y", [&](Reader& axis) { figure.y = {axis.text("label"), axis.text("unit"), axis.texts("names")}; });
    in.objects("curves", true, [&](Reader& item) {
        CurvesFigure::Curve curve{item.text("label"),  item.numbers("x"),    item.numbers("y"),
                                  item.numbers("low"), item.numbers("high"), item.flag("steps"),
                                  item.flag("points"), item.flag("open"),    item.numbers("n")};
        if (curve.y.size() != curve.x.size()) item.complain("y", "as long as \"x\"");
        if (!curve.low.empty() && curve.low.size() != curve.x.size()) item.complain("low", "as long as \"x\"");
        if (curve.high.size() != curve.low.size()) item.complain("high", "as long as \"low\"");
        if (!curve.n.empty() && curve.n.size() != curve.x.size()) item.complain("n", "as long as \"x\"");
        figure.curves.push_back(std::move(curve));
    });
    in.objects("lines", false, [&](Reader& item) { figure.lines.push_back({item.text("label"), item.number("y")}); });
    return figure;
}

}  // namespace

bool ExposureFigure::Row::evaluated() const { return std::isfinite(value); }

bool ExposureFigure::Row::over() const {
    if (!evaluated()) return false;
    if (within && !*within) return true;
    return std::isfinite(limit) && !(std::abs(value) <= limit);
}

bool ConditionsFigure::captured() const {
    return std::any_of(conditions.begin(), conditions.end(), [](const auto& each) { return !each.trains.empty(); });
}

Result<Figure> parseFigure(const QJsonObject& json) {
    const QString type = json.value(QLatin1String("type")).toString();
    Reader in("A figure of type \"" + type + "\"", json);
    Figure figure;
    if (type == "conditions") {
        figure.content = readConditions(in);
    } else if (type == "plane") {
        figure.content = readPlane(in);
    } else if (type == "waveforms") {
        figure.content = readWaveforms(in);
    } else if (type == "confusion") {
        figure.content = readConfusion(in);
    } else if (type == "exposure") {
        figure.content = readExposure(in);
    } else if (type == "timeline") {
        figure.content = readTimeline(in);
    } else if (type == "calibration") {
        figure.content = readCalibration(in);
    } else if (type == "transitions") {
        figure.content = readTransitions(in);
    } else if (type == "curves") {
        figure.content = readCurves(in);
    } else {
        return fail(ErrorCode::InvalidArgument,
                    "A figure's type is \"{}\"; it can be conditions, plane, waveforms, confusion, exposure, "
                    "timeline, calibration, transitions or curves.",
                    type.toStdString());
    }
    figure.note = in.text("note");
    if (!in.problem().isEmpty()) return fail(ErrorCode::InvalidArgument, "{}", in.problem().toStdString());
    return figure;
}

Result<void> resolveCaptures(Figure& figure, const CaptureLookup& lookup) {
    auto* waveforms = std::get_if<WaveformsFigure>(&figure.content);
    if (waveforms == nullptr) return {};
    for (auto& trace : waveforms->captures) {
        if (!trace.capture || !trace.voltage_v.empty() || !trace.current_a.empty()) continue;
        const auto capture = lookup(*trace.capture);
        if (!capture) return failure(capture);
        trace.rate_hz = capture->rate_hz;
        // Pulses are shown relative to their trigger; a record without a trigger starts at 0.
        trace.start_s = std::isfinite(capture->trigger_s) ? capture->start_s - capture->trigger_s : 0;
        for (const auto& channel : capture->channels) {
            auto& target = channel.unit == "A" ? trace.current_a : trace.voltage_v;
            if ((channel.unit == "A" || channel.unit == "V") && target.empty()) {
                target.assign(channel.samples.begin(), channel.samples.end());
            }
        }
    }
    return {};
}

}  // namespace tacto
