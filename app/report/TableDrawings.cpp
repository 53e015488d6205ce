// Figures that are tables with a picture in each cell: the confusion matrix, and exposure against limits.
#include <algorithm>
#include <iterator>

#include "app/report/FigureDrawing.h"
#include "app/report/Fonts.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"
#include "app/report/TableContent.h"

namespace tacto {
namespace {

QCPItemRect* addRect(PlotSheet& sheet, QCPAxisRect* axes, QRectF where, const QColor& fill, const QPen& edge) {
    auto* rect = new QCPItemRect(&sheet.plot());
    rect->setClipToAxisRect(false);
    for (auto* position : {rect->topLeft, rect->bottomRight}) {
        position->setAxisRect(axes);
        position->setAxes(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    }
    rect->topLeft->setCoords(where.left(), where.top());
    rect->bottomRight->setCoords(where.right(), where.bottom());
    rect->setBrush(fill.alpha() == 0 ? QBrush(Qt::NoBrush) : QBrush(fill));
    rect->setPen(edge);
    return rect;
}

QCPItemText* addText(PlotSheet& sheet, QCPAxisRect* axes, QPointF where, const QString& text, Qt::Alignment alignment) {
    auto* item = sheet.addNote(axes, text, {0, 0}, alignment);
    item->position->setType(QCPItemPosition::ptPlotCoords);
    item->position->setAxes(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    item->position->setCoords(where);
    return item;
}

/// A rectangle of slanted lines. The hatching is geometry, because neither SVG nor a photocopy keeps a pattern brush.
class HatchedRect : public QCPAbstractItem {
public:
    HatchedRect(PlotSheet& sheet, QCPAxisRect* axes, QRectF where)
        : QCPAbstractItem(&sheet.plot()), axes_(axes), where_(where) {
        setClipToAxisRect(false);
    }
    double selectTest(const QPointF&, bool, QVariant*) const override { return -1; }

protected:
    void draw(QCPPainter* painter) override {
        const auto* x = axes_->axis(QCPAxis::atBottom);
        const auto* y = axes_->axis(QCPAxis::atLeft);
        const QRectF box = QRectF(QPointF(x->coordToPixel(where_.left()), y->coordToPixel(where_.top())),
                                  QPointF(x->coordToPixel(where_.right()), y->coordToPixel(where_.bottom())))
                               .normalized();
        painter->setPen(QPen(ink::kHatch, 0.8));
        painter->setBrush(Qt::NoBrush);
        painter->drawRect(box);
        constexpr double kStep = 7;
        const int lines = static_cast<int>((box.width() + box.height()) / kStep);
        for (int i = 1; i <= lines; ++i) {
            const double offset = i * kStep;
            // Draws from the left or bottom edge to the top or right edge, at 45°.
            const double startX = std::max(0.0, offset - box.height());
            const double startY = std::min(offset, box.height());
            const double endX = std::min(offset, box.width());
            const double endY = std::max(0.0, offset - box.width());
            painter->drawLine(QPointF(box.left() + startX, box.top() + startY),
                              QPointF(box.left() + endX, box.top() + endY));
        }
    }

private:
    QCPAxisRect* axes_;
    QRectF where_;
};

/// Labels the ticks from a list, one at each whole number from 0.
QSharedPointer<QCPAxisTicker> labelTicker(const QStringList& labels) {
    auto ticker = QSharedPointer<QCPAxisTickerText>::create();
    for (int i = 0; i < labels.size(); ++i) ticker->addTick(i, labels[i]);
    return ticker;
}

QString shortened(const QString& text, const QFont& font, double width) {
    return QFontMetricsF(font).elidedText(text, Qt::ElideRight, width);
}

/// Rows that were not evaluated are drawn too; rows without a limit appear in the legend.
bool isDrawn(const ExposureFigure::Row& row) { return !row.evaluated() || (std::isfinite(row.limit) && row.limit > 0); }

QColor shade(double share) {
    // White to deep blue in a single hue, so that a grey print keeps the order.
    const auto mix = [&](int light, int dark) { return static_cast<int>(light + (dark - light) * share); };
    return QColor(mix(0xff, 0x0b), mix(0xff, 0x4f), mix(0xff, 0x87));
}

}  // namespace

std::unique_ptr<PlotSheet> drawConfusion(const ConfusionFigure& figure, bool simulated) {
    const auto rows = static_cast<int>(figure.labels.size());
    const auto columns = static_cast<int>(figure.columns.size());
    if (rows == 0 || columns == 0) return emptySheet("There are no classes to confuse.", simulated);
    double total = 0;
    for (const auto& row : figure.counts) {
        for (const double count : row) total += count;
    }
    if (!(total > 0)) return emptySheet("No trial was classified.", simulated);

    constexpr int kCell = 46;
    auto sheet = std::make_unique<PlotSheet>(kSheetWidth, rows * kCell + 74, simulated);
    auto* axes = sheet->addAxes(0, 0);
    const int side = std::max(24, (kSheetWidth - 150 - columns * 88) / 2);
    axes->setMinimumMargins(QMargins(side, 8, side, 8));
    auto* horizontal = axes->axis(QCPAxis::atBottom);
    auto* vertical = axes->axis(QCPAxis::atLeft);
    horizontal->setTicker(labelTicker(figure.columns));
    vertical->setTicker(labelTicker(figure.labels));
    horizontal->setRange(-0.5, columns - 0.5);
    vertical->setRange(-0.5, rows - 0.5);
    vertical->setRangeReversed(true);
    horizontal->setLabel(axisTitle(figure.answers));
    vertical->setLabel(axisTitle("Presented"));
    for (auto* axis : {horizontal, vertical}) {
        axis->grid()->setVisible(false);
        axis->setTickLength(0, 0);
        axis->setBasePen(Qt::NoPen);
    }
    if (columns > 6) horizontal->setTickLabelRotation(-35);
    for (int r = 0; r < rows; ++r) {
        const auto& row = figure.counts[static_cast<std::size_t>(r)];
        double sum = 0;
        for (const double count : row) sum += count;
        for (int c = 0; c < columns; ++c) {
            const double count = row[static_cast<std::size_t>(c)];
            const double share = sum > 0 ? count / sum : 0;
            addRect(*sheet, axes, QRectF(c - 0.5, r - 0.5, 1, 1), shade(share), QPen(ink::kGrid, 1.5));
            auto* text = addText(*sheet, axes, QPointF(c, r), QString::number(count), Qt::AlignCenter);
            text->setFont(textFont(13, count > 0));
            text->setColor(share > 0.45 ? QColor(Qt::white) : count > 0 ? ink::kText : ink::kAxis);
        }
    }
    // Cells are opaque, so the watermark lies over them, thin enough to leave the counts readable.
    if (simulated) {
        sheet->watermark(axes, 30);
        for (int i = 0; i < sheet->plot().itemCount(); ++i) {
            auto* mark = qobject_cast<QCPItemText*>(sheet->plot().item(i));
            if (mark != nullptr && mark->text() == "SIMULATED") {
                mark->setLayer("overlay");
                mark->setColor(QColor(0x60, 0x68, 0x70, 60));
            }
        }
    }
    return sheet;
}

std::unique_ptr<PlotSheet> drawExposure(const ExposureFigure& figure, bool simulated) {
    std::vector<ExposureFigure::Row> rows;
    std::copy_if(figure.rows.begin(), figure.rows.end(), std::back_inserter(rows), isDrawn);
    if (rows.empty()) return emptySheet("No exposure was evaluated against a limit.", simulated);
    constexpr int kRow = 18;
    constexpr double kReach = 1.15;  // the axis ends a little beyond the limit
    const auto count = static_cast<int>(rows.size());
    auto sheet = std::make_unique<PlotSheet>(kSheetWidth, count * kRow + 52, simulated);
    auto* axes = sheet->addAxes(0, 0);
    axes->setMinimumMargins(QMargins(4, 6, 4, 4));
    sheet->watermark(axes);
    auto* share = axes->axis(QCPAxis::atBottom);
    auto* names = axes->axis(QCPAxis::atLeft);
    QStringList labels;
    for (const auto& row : rows) {
        const QString label =
            capitalised(loadText(row.name)) + (row.source.isEmpty() ? QString() : " · " + limitSetTitle(row.source));
        labels << shortened(label, textFont(10), 290);
    }
    names->setTicker(labelTicker(labels));
    names->setRange(-0.6, count - 0.4);
    names->setRangeReversed(true);
    names->setTickLength(0, 0);
    names->grid()->setVisible(false);
    share->setRange(0, 100 * kReach);
    share->setLabel(axisTitle("Share of the limit", "%"));
    auto* limit = new QCPItemLine(&sheet->plot());
    limit->setClipToAxisRect(false);
    for (auto* position : {limit->start, limit->end}) {
        position->setAxisRect(axes);
        position->setAxes(share, names);
    }
    limit->start->setCoords(100, -0.6);
    limit->end->setCoords(100, count - 0.4);
    limit->setPen(QPen(ink::kText, 1.2));

    double widest = 0;
    for (int i = 0; i < count; ++i) {
        const auto& row = rows[static_cast<std::size_t>(i)];
        const auto beside = [&](const QString& text) {
            const QString brief = shortened("  " + text, textFont(10, true), 250);
            widest = std::max(widest, QFontMetricsF(textFont(10, true)).horizontalAdvance(brief));
            return addText(*sheet, axes, QPointF(100 * kReach, i), brief, Qt::AlignLeft | Qt::AlignVCenter);
        };
        if (!row.evaluated()) {
            new HatchedRect(*sheet, axes, QRectF(0, i - 0.32, 100, 0.64));
            beside("not evaluated");
            continue;
        }
        const double fraction = std::abs(row.value) / row.limit;
        const bool over = row.over();
        const QColor color = over && !row.warning ? ink::kFault : fraction >= 0.8 ? ink::kAmber : ink::kBar;
        addRect(*sheet, axes, QRectF(0, i - 0.32, 100 * std::min(fraction, kReach), 0.64), color,
                QPen(color.darker(125), 0.8));
        QString text = quantityText(row.value, row.unit, 3) + " of " + settingText(row.limit, row.unit);
        if (!row.reason.isEmpty()) text += ", " + row.reason;
        if (over) text += row.warning ? ": attention" : ": over the limit";
        beside(text)->setFont(textFont(10, over));
    }
    axes->setMinimumMargins(QMargins(4, 6, static_cast<int>(widest) + 8, 4));
    return sheet;
}

QString exposureLegend(const ExposureFigure& figure) {
    QString legend = "Share of each limit; amber from 80\u202f%. Hatched: not evaluated, and so not passed.";
    QStringList why, unlimited;
    for (const auto& row : figure.rows) {
        if (!row.evaluated() && !row.reason.isEmpty()) {
            const QString text = row.name + ": " + row.reason;
            if (!why.contains(text)) why << text;
        } else if (!isDrawn(row)) {
            unlimited << row.name + " " + quantityText(row.value, row.unit, 3);
        }
    }
    if (!why.isEmpty()) legend += " Not evaluated: " + why.join("; ") + ".";
    if (!unlimited.isEmpty()) legend += " Without a limit: " + unlimited.join(", ") + ".";
    return legend;
}

}  // namespace tacto
