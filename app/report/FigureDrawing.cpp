#include "app/report/FigureDrawing.h"

#include <QBuffer>
#include <QFontMetricsF>
#include <QRegularExpression>
#include <QSvgGenerator>
#include <cmath>

#include "app/report/Fonts.h"
#include "app/report/NumberText.h"

namespace tacto {

namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
    using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

QString conditionsLegend(const ConditionsFigure& figure) {
    if (figure.captured()) {
        QString text =
            "Every stem is a captured train, from its lowest to its highest sample; right, the first pulse of each. "
            "Numbers are the means of all trials and their s.d.";
        const auto& all = figure.conditions;
        if (all.size() == 4 && all[0].name == "smooth-low" && all[3].name == "rough-high") {
            text += " A to C: texture alone. A to B: pressure alone. A to D: both.";
        }
        return text;
    }
    QString text = "Heights and spacings are the measured means, with their s.d. where there is room.";
    double least = kUnknown, most = kUnknown;
    for (const auto& condition : figure.conditions) {
        if (!std::isfinite(condition.n)) continue;
        least = std::fmin(least, condition.n);
        most = std::fmax(most, condition.n);
    }
    if (std::isfinite(least)) {
        text += least == most ? QString("; n = %1 for each condition").arg(least)
                              : QString("; n = %1 to %2 for each condition").arg(least).arg(most);
    }
    return text + ".";
}

QString confusionLegend(const ConfusionFigure& figure) {
    double total = 0;
    for (const auto& row : figure.counts) {
        for (const double count : row) total += count;
    }
    QString text = QString("Counts of %1 trials.").arg(total);
    if (std::isfinite(figure.accuracy.value)) {
        text += " Accuracy " + proportionText(figure.accuracy);
        if (std::isfinite(figure.accuracy.low)) text += ", 95" + QString(QChar(0x202f)) + "% interval";
        text += ".";
    }
    return text;
}

}  // namespace

std::unique_ptr<PlotSheet> drawFigure(const Figure& figure, bool simulated) {
    return std::visit(Overloaded{[&](const ConditionsFigure& content) { return drawConditions(content, simulated); },
                                 [&](const PlaneFigure& content) { return drawPlane(content, simulated); },
                                 [&](const WaveformsFigure& content) { return drawWaveforms(content, simulated); },
                                 [&](const ConfusionFigure& content) { return drawConfusion(content, simulated); },
                                 [&](const ExposureFigure& content) { return drawExposure(content, simulated); },
                                 [&](const TimelineFigure& content) { return drawTimeline(content, simulated); },
                                 [&](const CalibrationFigure& content) { return drawCalibration(content, simulated); },
                                 [&](const TransitionsFigure& content) { return drawTransitions(content, simulated); },
                                 [&](const CurvesFigure& content) { return drawCurves(content, simulated); }},
                      figure.content);
}

QString figureLegend(const Figure& figure) {
    QString text = std::visit(
        Overloaded{[](const ConditionsFigure& content) {
                       return content.conditions.empty() ? QString() : conditionsLegend(content);
                   },
                   [](const PlaneFigure& content) {
                       return content.trials.empty()
                                  ? QString()
                                  : QString(
                                        "Each point is a trial. Right: each condition enlarged, as deviation from "
                                        "its mean, with the ellipse that holds 95\u202f% of a normal distribution.");
                   },
                   [](const WaveformsFigure& content) {
                       const auto all = content.captures.size();
                       const QString which =
                           all > kWaveformsShown
                               ? QString(" The first %1 of %2; the session holds all.").arg(kWaveformsShown).arg(all)
                               : QString();
                       return "Measured. Time counts from the trigger where there was one." + which;
                   },
                   [](const ConfusionFigure& content) { return confusionLegend(content); },
                   [](const ExposureFigure& content) { return exposureLegend(content); },
                   [](const TimelineFigure&) {
                       return QString("Bars are the trains delivered, the line is what the encoder asked for.");
                   },
                   [](const CalibrationFigure& content) {
                       return content.errors ? QString(
                                                   "Left, dashed: the tolerance; bars: expanded uncertainty, "
                                                   "95\u202f%. Right: how far the two directions are apart.")
                                             : QString("Each point is a reading.");
                   },
                   [](const TransitionsFigure& content) {
                       return QString(
                                  "A cell holds the largest step, in just-noticeable differences, that a finger feels "
                                  "between two trains on its way through; amber is more than the %1 wanted, the frame "
                                  "marks where the largest is.")
                           .arg(content.wanted_jnd);
                   },
                   [](const CurvesFigure&) { return QString(); }},
        figure.content);
    if (!figure.note.isEmpty()) text = (figure.note + " " + text).trimmed();
    return text;
}

QByteArray sheetSvg(PlotSheet& sheet, const QString& title) {
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    QSvgGenerator generator;
    generator.setOutputDevice(&buffer);
    generator.setResolution(96);
    generator.setSize(sheet.size());
    generator.setViewBox(QRect(QPoint(0, 0), sheet.size()));
    QCPPainter painter;
    painter.begin(&generator);
    sheet.paint(painter);
    painter.end();
    buffer.close();

    QString svg = QString::fromUtf8(buffer.data());
    const auto end = [&](const char* what) { return svg.indexOf(QLatin1String(what)); };
    const auto body = svg.mid(end("</desc>") + 7);
    svg = QString(
              "<svg viewBox=\"0 0 %1 %2\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\" "
              "xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n<title>%3</title>")
              .arg(sheet.size().width())
              .arg(sheet.size().height())
              .arg(title.toHtmlEscaped()) +
          body;
    return visible(withWholeTexts(svg)).toUtf8();
}

std::vector<std::size_t> visiblePoints(std::span<const double> values, std::size_t keep) {
    std::vector<std::size_t> points;
    if (values.size() <= 3 * keep || keep == 0) {
        points.resize(values.size());
        for (std::size_t i = 0; i < points.size(); ++i) points[i] = i;
        return points;
    }
    for (std::size_t bucket = 0; bucket < keep; ++bucket) {
        const std::size_t begin = bucket * values.size() / keep;
        const std::size_t end = (bucket + 1) * values.size() / keep;
        std::vector<std::size_t> chosen{begin, end - 1};
        std::optional<std::size_t> low, high, gap;
        for (std::size_t i = begin; i < end; ++i) {
            if (!std::isfinite(values[i])) {
                gap = i;
            } else {
                if (!low || values[i] < values[*low]) low = i;
                if (!high || values[i] > values[*high]) high = i;
            }
        }
        for (const auto& index : {low, high, gap}) {
            if (index) chosen.push_back(*index);
        }
        std::sort(chosen.begin(), chosen.end());
        chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
        points.insert(points.end(), chosen.begin(), chosen.end());
    }
    return points;
}

std::unique_ptr<PlotSheet> emptySheet(const QString& why, bool simulated) {
    auto sheet = std::make_unique<PlotSheet>(kSheetWidth, 90, simulated);
    sheet->explain(sheet->addAxes(0, 0), why);
    return sheet;
}

namespace {

constexpr double kTouching = 1.0;  // px between the end of a text and the beginning of its continuation

double advanceOf(const QString& escaped, double size, int weight) {
    QString text = escaped;
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&");
    return QFontMetricsF(textFont(size, weight >= QFont::Bold)).horizontalAdvance(text);
}

}  // namespace

QString withWholeTexts(const QString& svg) {
    static const QRegularExpression kText(
        R"re(<text ([^>]*?)x="([^"]*)" y="([^"]*)" )re"
        R"re(([^>]*?font-size="([^"]*)" font-weight="([^"]*)"[^>]*)>([^<]*)</text>)re");
    QString out;
    qsizetype taken = 0;
    double end = 0;  // where the previous text ends
    QRegularExpressionMatch before;
    for (auto all = kText.globalMatch(svg); all.hasNext();) {
        const auto now = all.next();
        const double x = now.captured(2).toDouble();
        const bool goesOn = before.hasMatch() && svg.mid(taken, now.capturedStart() - taken).trimmed().isEmpty() &&
                            before.captured(1) == now.captured(1) && before.captured(3) == now.captured(3) &&
                            before.captured(4) == now.captured(4) && std::abs(x - end) <= kTouching;
        if (goesOn) {
            out.chop(static_cast<qsizetype>(sizeof "</text>") - 1);
            out += now.captured(7) + "</text>";
        } else {
            out += svg.mid(taken, now.capturedEnd() - taken);
        }
        end = x + advanceOf(now.captured(7), now.captured(5).toDouble(), now.captured(6).toInt());
        taken = now.capturedEnd();
        before = now;
    }
    out += svg.mid(taken);
    // Open Sans and Segoe UI are nearly as wide as Noto Sans; Verdana is as wide as DejaVu Sans.
    return out
        .replace("font-family=\"Noto Sans\"",
                 "font-family=\"'Noto Sans','Noto Sans Math','Open Sans','Segoe UI','DejaVu Sans',sans-serif\"")
        .replace("font-family=\"DejaVu Sans\"", "font-family=\"'DejaVu Sans',Verdana,sans-serif\"");
}

}  // namespace tacto
