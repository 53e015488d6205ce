#include "tests/report/Samples.h"

#include <QFile>
#include <QJsonArray>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/report/FigureDrawing.h"
#include "core/base/Random.h"

namespace tacto::test {
namespace {

struct Condition {
    const char* name;
    double amplitude_v;
    double interval_s;
};
constexpr std::array<Condition, 4> kConditions{
    {{"smooth-low", 10, 2}, {"smooth-high", 10, 0.5}, {"rough-low", 40, 2}, {"rough-high", 40, 0.5}}};

QJsonArray names() {
    QJsonArray array;
    for (const auto& condition : kConditions) array << QString(condition.name);
    return array;
}

QJsonObject statistic(double mean, double sd) {
    return {{"mean", mean}, {"sd", sd}, {"median", mean}, {"min", mean - 2 * sd}, {"max", mean + 2 * sd}, {"n", 25}};
}

/// A symmetric biphasic pulse of 2 x 200 us with a 100 us gap, into 1 kohm.
double pulse(double t, double amplitude) {
    const auto edge = [&](double at) { return 1 / (1 + std::exp(-(t - at) / 2e-6)); };
    return amplitude * (edge(0) - edge(200e-6)) - amplitude * (edge(300e-6) - edge(500e-6));
}

}  // namespace

QJsonObject planeJson(int repeats) {
    Random random(7, "plane");
    QJsonArray trials;
    for (int i = 0; i < repeats; ++i) {
        for (const auto& condition : kConditions) {
            trials << QJsonObject{{"condition", condition.name},
                                  {"amplitude_v", condition.amplitude_v * (1.003 + 0.004 * random.normal())},
                                  {"interval_s", condition.interval_s + 40e-6 * random.normal()}};
        }
    }
    return {{"type", "plane"}, {"trials", trials}};
}

QJsonObject conditionsJson() {
    QJsonArray conditions;
    for (const auto& condition : kConditions) {
        conditions << QJsonObject{
            {"name", condition.name},
            {"n", 25},
            {"amplitude_v", statistic(condition.amplitude_v * 1.003, condition.amplitude_v * 0.004)},
            {"interval_s", statistic(condition.interval_s, 40e-6)}};
    }
    return {{"type", "conditions"}, {"conditions", conditions}};
}

QJsonObject waveformsJson() {
    Random random(7, "waveforms");
    QJsonArray captures;
    for (const auto& condition : kConditions) {
        QJsonArray voltage, current;
        for (int i = 0; i < 2000; ++i) {
            const double v = pulse(i * 1e-6 - 500e-6, condition.amplitude_v);
            voltage << v + 0.05 * random.normal();
            current << v / 1000 + 5e-5 * random.normal();
        }
        captures << QJsonObject{{"condition", condition.name},
                                {"rate_hz", 1e6},
                                {"start_s", -500e-6},
                                {"voltage_v", voltage},
                                {"current_a", current}};
    }
    return {{"type", "waveforms"}, {"captures", captures}};
}

QJsonObject confusionJson() {
    const QJsonArray counts{QJsonArray{25, 0, 0, 0}, QJsonArray{0, 24, 0, 1}, QJsonArray{0, 0, 25, 0},
                            QJsonArray{0, 0, 0, 25}};
    return {{"type", "confusion"},
            {"labels", names()},
            {"confusion", counts},
            {"accuracy", QJsonObject{{"value", 0.99}, {"low", 0.9455}, {"high", 0.9982}}}};
}

QJsonObject exposureJson() {
    const QJsonArray rows{
        QJsonObject{
            {"name", "RMS current over 5 s"}, {"value", 2.26}, {"limit", 10}, {"unit", "mA"}, {"source", "paper"}},
        QJsonObject{{"name", "Command voltage"}, {"value", 40}, {"limit", 40}, {"unit", "V"}, {"source", "paper"}},
        QJsonObject{{"name", "RMS current over 5 s"},
                    {"value", 2.26},
                    {"limit", 50},
                    {"unit", "mA"},
                    {"source", "iec-60601-2-10"}},
        QJsonObject{{"name", "Energy per pulse"},
                    {"value", 1.28},
                    {"limit", 300},
                    {"unit", "mJ"},
                    {"source", "iec-60601-2-10"}},
        QJsonObject{{"name", "Power density"},
                    {"value", QJsonValue::Null},
                    {"limit", 0.25},
                    {"unit", "W/cm2"},
                    {"source", "fda-pms"},
                    {"reason", "no electrode area"}},
        QJsonObject{{"name", "Current density"},
                    {"value", 2.4},
                    {"limit", 2},
                    {"unit", "mA/cm2"},
                    {"source", "iec-60601-2-10"},
                    {"warning", true}}};
    return {{"type", "exposure"}, {"rows", rows}};
}

QJsonObject timelineJson(int frames) {
    QJsonArray t, r, p, a, trains;
    double next = 0;
    for (int i = 0; i < frames; ++i) {
        const double time = i * 0.016;
        const bool contact = std::fmod(time, 7.0) < 5.5;
        const double rough = 0.5 + 0.4 * std::sin(time * 1.3);
        const double press = 0.5 + 0.4 * std::sin(time * 0.7 + 1);
        t << time;
        r << (contact ? QJsonValue(rough) : QJsonValue(QJsonValue::Null));
        p << (contact ? QJsonValue(press) : QJsonValue(QJsonValue::Null));
        a << (contact ? QJsonValue(10 + 30 * rough) : QJsonValue(QJsonValue::Null));
        if (contact && time >= next) {
            trains << QJsonObject{{"t_s", time}, {"amplitude_v", 10 + 30 * rough}, {"refused", trains.size() % 9 == 4}};
            next = time + 2 - 1.5 * press;
        }
    }
    const QJsonArray faults{QJsonObject{{"t_s", frames * 0.016 * 0.8}, {"text", "electrode open"}}};
    return {{"type", "timeline"}, {"t_s", t},         {"r", r},          {"p", p},
            {"amplitude_v", a},   {"trains", trains}, {"faults", faults}};
}

QJsonObject emptyFigureJson(const QString& type) {
    QJsonObject json{{"type", type}};
    if (type == "conditions") json["conditions"] = QJsonArray{};
    if (type == "plane") json["trials"] = QJsonArray{};
    if (type == "waveforms") json["captures"] = QJsonArray{};
    if (type == "confusion") json["labels"] = QJsonArray{}, json["confusion"] = QJsonArray{};
    if (type == "exposure") json["rows"] = QJsonArray{};
    return json;
}

ReportModel separabilityModel(bool simulated, int repeats) {
    ReportModel model;
    model.title = "Signal separability";
    model.purpose = "Can an oscilloscope tell the four tactile conditions apart?";
    model.protocol = "separability";
    model.session = "2026-11-20-separability-7";
    model.started = "2026-11-20T14:03:05Z";
    model.duration_s = 261.4;
    model.verdict = ReportVerdict::Indeterminate;
    model.reasons = {
        "Every pair of conditions is at least 14.5 just-noticeable differences apart (needs 5).",
        "The coefficient of variation is at most 0.41 % (allowed 5 %).",
        "99 of 100 trials were classified correctly; the lower end of the 95 % interval, 94.6 %, is below 95 %."};
    model.simulated = simulated;
    model.chainHead = "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08";
    model.devices = {
        {"stimulator",
         "Simulated voltage stimulator",
         "sim:stimulator?mode=voltage&gain=1.003",
         "SIM-0001",
         "1",
         simulated,
         {}},
        {"oscilloscope", "Simulated oscilloscope, 10 MS/s", "sim:oscilloscope", "SIM-0002", "1", simulated, {}},
        {"sensor", "Simulated finger", "sim:sensor", "SIM-0003", "", simulated, {}}};
    model.settings = {{"Repeats per condition", "25"}, {"Drive from", "simulated or real finger"}, {"Load", "1 kΩ"}};
    model.identity = {{"Program", "Tactoscope 0.1.0"},
                      {"Seed", "7"},
                      {"Script separability", std::string(64, 'a').c_str(), true},
                      {"Encoding profile", std::string(64, 'b').c_str(), true},
                      {"Limits paper", std::string(64, 'c').c_str(), true}};
    const auto add = [&](const char* caption, const QJsonObject& json) {
        model.items.emplace_back(ReportFigure{caption, parseFigure(json).value()});
    };
    add("The four conditions", conditionsJson());
    add("Amplitude and interval", planeJson(repeats));
    add("Measured pulses", waveformsJson());
    add("Classification of the trials", confusionJson());
    QJsonArray pairs;
    for (int i = 0; i < 4; ++i) {
        for (int k = i + 1; k < 4; ++k) {
            pairs << QJsonObject{{"a", kConditions[std::size_t(i)].name},
                                 {"b", kConditions[std::size_t(k)].name},
                                 {"mahalanobis", 52.31 * (i + k)},
                                 {"jnd", 14.5 * k}};
        }
    }
    model.items.emplace_back(ReportTable{"Pairs", {"a", "b", "mahalanobis", "jnd"}, pairs});
    QJsonArray trials;
    const auto plane = planeJson(repeats)["trials"].toArray();
    for (const auto& trial : plane) trials << trial;
    model.items.emplace_back(ReportTable{"Trials", {"condition", "amplitude_v", "interval_s"}, trials});
    add("The run over time", timelineJson(2500));
    model.exposure = std::get<ExposureFigure>(parseFigure(exposureJson()).value().content).rows;
    model.events = {{12.5, "refused", "Peak current over the limit of the profile.", 3},
                    {131.04, "fault", "Electrode open."}};
    model.reproduce = {
        "tactoscope-cli run separability --device sim: --set repeats=25 --set source=finger --set load=1000 "
        "--seed 7",
        "tactoscope-cli verify 2026-11-20-separability-7.tacto"};
    return model;
}

std::string drawn(const QJsonObject& figure, bool simulated) {
    return sheetSvg(*drawFigure(parseFigure(figure).value(), simulated), "A figure").toStdString();
}

std::string poppler(const std::string& command, const std::filesystem::path& pdf) {
    const std::string line =
        command + " '" + pdf.string() + "'" + (command.starts_with("pdftotext") ? " -" : "") + " 2>/dev/null";
    std::string output;
    FILE* pipe = popen(line.c_str(), "r");
    if (pipe == nullptr) return output;
    std::array<char, 4096> buffer{};
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), n);
    return pclose(pipe) == 0 ? output : std::string();
}

bool havePoppler() { return std::system("pdftotext -v >/dev/null 2>&1") == 0; }

QByteArray contentOfFile(const std::filesystem::path& path) {
    QFile file(QString::fromStdString(path.string()));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace tacto::test
