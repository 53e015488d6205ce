// The paper's figure: the effect of texture alone, pressure alone and both together on the pulse trains.
#include "app/report/FigureDrawing.h"
#include "app/report/Fonts.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

using Condition = ConditionsFigure::Condition;
using Lane = const Condition*;

struct Panel {
    QString title;
    QString missing;  ///< the text if there are no lanes
    std::vector<Lane> lanes;
};

QString textureOf(const Condition& c) { return c.name.section('-', 0, 0); }
QString pressureOf(const Condition& c) { return c.name.section('-', 1, 1); }

/// Returns the first two conditions with one equal word in their names and one different word.
std::vector<Lane> pairDiffering(const std::vector<Condition>& all, QString (*shared)(const Condition&),
                                QString (*differing)(const Condition&)) {
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t k = i + 1; k < all.size(); ++k) {
            if (!shared(all[i]).isEmpty() && shared(all[i]) == shared(all[k]) &&
                differing(all[i]) != differing(all[k])) {
                return {&all[i], &all[k]};
            }
        }
    }
    return {};
}

bool known(const Condition& c) {
    return std::isfinite(c.amplitude_v.mean) && std::isfinite(c.interval_s.mean) && c.interval_s.mean > 0;
}

constexpr int kTitleHeight = 20;
constexpr int kLaneHeight = 70;     // height of a lane, including the strip with name and numbers
constexpr double kHeadroom = 1.18;  // leaves room for the markers
constexpr int kStripHeight = 15;
constexpr int kAxisHeight = 34;

class ConditionsSheet {
public:
    ConditionsSheet(const ConditionsFigure& figure, bool simulated, std::size_t rows)
        : figure_(figure),
          sheet_(std::make_unique<PlotSheet>(kSheetWidth, heightOf(rows), simulated)),
          margins_(new QCPMarginGroup(&sheet_->plot())) {
        double longest = 0, highest = 0;
        for (const auto& condition : figure.conditions) {
            if (!known(condition)) continue;
            longest = std::max(longest, condition.interval_s.mean);
            highest = std::max(highest, std::abs(condition.amplitude_v.mean));
        }
        span_ = 2.2 * longest;
        top_ = kHeadroom * (highest > 0 ? highest : 1);
    }

    static int heightOf(std::size_t rows) {
        return static_cast<int>(rows) * kLaneHeight + 2 * kTitleHeight + kAxisHeight;
    }

    void addPanel(QCPLayoutGrid* grid, const Panel& panel, bool timeAxis) {
        int row = grid->rowCount();
        sheet_->addTitle(row++, 0, panel.title, true, grid);
        if (panel.lanes.empty()) {
            auto* axes = addLaneAxes(grid, row, timeAxis);
            sheet_->explain(axes, panel.missing);
        }
        for (std::size_t i = 0; i < panel.lanes.size(); ++i) {
            // Takes as much room as a title, so that the lanes on the left and right line up.
            if (i == 2) sheet_->addTitle(row++, 0, {}, false, grid);
            auto* axes = addLaneAxes(grid, row++, timeAxis && i + 1 == panel.lanes.size());
            drawLane(axes, *panel.lanes[i]);
        }
    }

    PlotSheet& sheet() { return *sheet_; }
    std::unique_ptr<PlotSheet> take() { return std::move(sheet_); }

private:
    QCPAxisRect* addLaneAxes(QCPLayoutGrid* grid, int row, bool timeAxis) {
        auto* axes = sheet_->addAxes(row, 0, grid);
        axes->setMinimumMargins(QMargins(4, kStripHeight + 2, 8, 3));
        axes->setMarginGroup(QCP::msLeft, margins_);
        auto* time = axes->axis(QCPAxis::atBottom);
        auto* level = axes->axis(QCPAxis::atLeft);
        time->setRange(-0.03 * span_, span_);
        level->setRange(0, top_);
        level->setTicker(
            QSharedPointer<PlainTicker>::create(2, roundBelow(top_ / kHeadroom), QStringLiteral("\u202fV")));
        level->grid()->setVisible(false);
        time->setTickLabels(timeAxis);
        axes->setMaximumSize(QWIDGETSIZE_MAX, kLaneHeight + (timeAxis ? kAxisHeight : 0));
        axes->setMinimumSize(40, kLaneHeight + (timeAxis ? kAxisHeight : 0));
        axes->setSizeConstraintRect(QCPLayoutElement::scrOuterRect);
        if (timeAxis) time->setLabel(axisTitle("Time", "s"));
        return axes;
    }

    void drawLane(QCPAxisRect* axes, const Condition& condition) {
        const auto index = static_cast<int>(&condition - figure_.conditions.data());
        const auto style = conditionStyle(condition.name, index);
        sheet_->watermark(axes, 14);
        auto* name = sheet_->addNote(axes, condition.name, {0, -0.02}, Qt::AlignLeft | Qt::AlignBottom);
        name->setFont(textFont(10, true));
        if (!known(condition)) {
            sheet_->addNote(axes, "not measured", {0.5, 0.6})->setColor(ink::kQuiet);
            return;
        }
        const auto widthOf = [](const QString& text) { return QFontMetricsF(textFont(10)).horizontalAdvance(text); };
        constexpr double kRoom = 300;  // room of a lane in half a sheet
        QString numbers = spreadText(condition.amplitude_v.mean, condition.amplitude_v.sd, "V") + ";  " +
                          spreadText(condition.interval_s.mean, condition.interval_s.sd, "s");
        if (widthOf(condition.name + "   " + numbers) > kRoom)  // then without the spread
            numbers =
                quantityText(condition.amplitude_v.mean, "V") + ";  " + quantityText(condition.interval_s.mean, "s");
        sheet_->addNote(axes, numbers, {1, -0.02}, Qt::AlignRight | Qt::AlignBottom);
        auto* trains = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
        trains->setLineStyle(QCPGraph::lsImpulse);
        QPen stems = style.pen(2);
        // A short pulse is only a few units high, so it gets a denser dot pattern than a curve.
        if (style.dash == Qt::DotLine) stems.setDashPattern({1, 1});
        trains->setPen(stems);
        trains->setScatterStyle(
            QCPScatterStyle(style.marker, QPen(style.color, 1.2),
                            style.marker == QCPScatterStyle::ssDisc ? QBrush(style.color) : QBrush(Qt::white), 5));
        // A damaged mean could require millions of trains; more than 200 look like a solid bar anyway.
        const int count = std::min(200, static_cast<int>(span_ / condition.interval_s.mean) + 1);
        for (int i = 0; i < count; ++i) {
            trains->addData(i * condition.interval_s.mean, std::abs(condition.amplitude_v.mean));
        }
    }

    const ConditionsFigure& figure_;
    std::unique_ptr<PlotSheet> sheet_;
    QCPMarginGroup* margins_;  // owned by the plot
    double span_ = 1;
    double top_ = 1;
};

}  // namespace

std::unique_ptr<PlotSheet> drawConditions(const ConditionsFigure& figure, bool simulated) {
    const auto& all = figure.conditions;
    if (figure.captured()) return drawCapturedConditions(figure, simulated);
    if (std::none_of(all.begin(), all.end(), known)) {
        return emptySheet(
            all.empty() ? "No condition was measured." : "No condition has a measured amplitude and interval.",
            simulated);
    }
    const Panel texture{"Texture alone: amplitude changes", "No two conditions differ in texture alone.",
                        pairDiffering(all, pressureOf, textureOf)};
    const Panel pressure{"Pressure alone: interval changes", "No two conditions differ in pressure alone.",
                         pairDiffering(all, textureOf, pressureOf)};
    Panel both{"Texture and pressure combined", {}, {}};
    for (const auto& condition : all) both.lanes.push_back(&condition);

    ConditionsSheet drawing(figure, simulated, std::max<std::size_t>(4, both.lanes.size()));
    auto* left = drawing.sheet().addGrid(0, 0);
    auto* right = drawing.sheet().addGrid(0, 1);
    drawing.addPanel(left, texture, false);
    drawing.addPanel(left, pressure, true);
    drawing.addPanel(right, both, true);
    return drawing.take();
}

}  // namespace tacto
