#include "app/gui/theme/ExposureTable.h"

#include <QHeaderView>
#include <QObject>
#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/TableText.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"
#include "app/report/ResultCells.h"
#include "core/safety/TrainExposure.h"

namespace tacto::gui {

namespace {

constexpr int kShare = Qt::UserRole;          // double; invalid without a limit or a value
constexpr int kEvaluated = Qt::UserRole + 1;  // bool
constexpr int kBroken = Qt::UserRole + 2;     // bool: a limit that refuses output is exceeded
constexpr int kQuantity = 0, kValue = 1, kLimit = 2, kUsed = 3;
constexpr int kWideChars = 75;  // width in characters from which the bar has its own column

/// A thin bar that shows the used share of a limit; hatched if the row was not evaluated.
void paintShare(QPainter& painter, const QRectF& frame, const QModelIndex& index, const QPalette& palette) {
    const auto& c = colours();
    const auto used = index.data(kShare);
    const double share = used.toDouble();
    painter.save();
    painter.setPen(QPen(palette.color(QPalette::Mid), 1));
    if (!index.data(kEvaluated).toBool()) {
        painter.setBrush(QBrush(c.quiet, Qt::BDiagPattern));
        painter.drawRect(frame);
    } else if (used.isValid()) {
        painter.setBrush(palette.color(QPalette::Midlight));
        painter.drawRect(frame);
        painter.setPen(Qt::NoPen);
        painter.setBrush(index.data(kBroken).toBool() ? c.fail : share >= 0.8 ? c.amber : c.bar);
        painter.drawRect(
            QRectF(frame.left(), frame.top(), frame.width() * std::clamp(share, 0.0, 1.0), frame.height()));
    }
    painter.restore();
}

class BarDelegate final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;
    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const double inset = option.rect.height() * 0.3;
        paintShare(*painter, QRectF(option.rect).adjusted(3.5, inset, -3.5, -inset), index, option.palette);
    }
};

/// Paints the quantity, and the bar below it while the bar has no column of its own.
class QuantityDelegate final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;
    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const auto* table = qobject_cast<const QTableView*>(option.widget);
        if (table == nullptr || !table->isColumnHidden(kUsed) || !index.data(kEvaluated).isValid())
            return QStyledItemDelegate::paint(painter, option, index);
        auto above = option;
        const int height = std::max(4, option.rect.height() / 5);
        above.rect.adjust(0, 0, 0, -height);
        QStyledItemDelegate::paint(painter, above, index);
        paintShare(*painter,
                   QRectF(option.rect.left() + 3.5, option.rect.bottom() - height - 0.5, option.rect.width() - 7.0,
                          height - 1.0),
                   index, option.palette);
    }
};

/// "< 10 mA", "≤ 2 mA/cm² (warning)"; "–" without a limit.
QString limitText(const ExposureRow& row, bool compact = false) {
    if (std::isnan(row.limit)) return "–";
    const auto limit = (row.strict ? QString("< ") : QString("≤ ")) + settingText(row.limit, qtext(row.unit));
    if (compact) return limit;
    switch (row.action) {
        case LimitAction::Warn:
            return QObject::tr("%1 (warning)").arg(limit);
        case LimitAction::Disclose:
            return QObject::tr("%1 (to be stated)").arg(limit);
        case LimitAction::Refuse:
            break;
    }
    return limit;
}

}  // namespace

QString rowTitle(const ExposureRow& row) {
    const auto title = qtext(titleOf(row.quantity));
    return row.judged == JudgedAt::Ohm500 ? QObject::tr("%1 into 500 Ω").arg(title) : title;
}

QString shortRowTitle(const ExposureRow& row) {
    struct Short {
        const char* name;
        const char* into500Ohm;
    };
    static constexpr std::array<Short, kQuantityCount> kShort{{
        {QT_TRANSLATE_NOOP("QObject", "Voltage set"), QT_TRANSLATE_NOOP("QObject", "Set, 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "Peak voltage"), QT_TRANSLATE_NOOP("QObject", "Peak V, 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "Peak current"), QT_TRANSLATE_NOOP("QObject", "Peak mA, 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "Phase charge"), QT_TRANSLATE_NOOP("QObject", "Phase, 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "Net charge"), QT_TRANSLATE_NOOP("QObject", "Net, 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "Energy a pulse"), QT_TRANSLATE_NOOP("QObject", "Energy, 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "RMS in train"), QT_TRANSLATE_NOOP("QObject", "Train, 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "RMS over 1 s"), QT_TRANSLATE_NOOP("QObject", "1 s, 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "RMS over 5 s"), QT_TRANSLATE_NOOP("QObject", "RMS into 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "RMS voltage"), QT_TRANSLATE_NOOP("QObject", "RMS V, 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "Mean over 5 s"), QT_TRANSLATE_NOOP("QObject", "Mean into 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "Current/cm²"), QT_TRANSLATE_NOOP("QObject", "I/cm², 500 Ω")},
        {QT_TRANSLATE_NOOP("QObject", "Power/cm²"), QT_TRANSLATE_NOOP("QObject", "P/cm², 500 Ω")},
    }};
    const auto& names = kShort[indexOf(row.quantity)];
    return QObject::tr(row.judged == JudgedAt::Ohm500 ? names.into500Ohm : names.name);
}

ExposureTable::ExposureTable(QWidget* parent) : QTableWidget(0, 4, parent) {
    setHorizontalHeaderLabels({tr("Quantity"), tr("Value"), tr("Limit"), tr("Used")});
    horizontalHeaderItem(kQuantity)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    for (const int column : {kValue, kLimit})
        horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    makeReadOnly(*this);
    setSelectionBehavior(QAbstractItemView::SelectRows);
    setWordWrap(false);
    setShowGrid(false);
    setItemDelegateForColumn(kQuantity, new QuantityDelegate(this));
    setItemDelegateForColumn(kUsed, new BarDelegate(this));
    auto* header = horizontalHeader();
    header->setSectionResizeMode(kQuantity, QHeaderView::Stretch);
    for (const int column : {kValue, kLimit}) header->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    header->resizeSection(kUsed, fontMetrics().horizontalAdvance("not evaluated"));
    header->setHighlightSections(false);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    measure();
    onLookChange(*this, [this] {
        measure();
        fill();
    });
}

void ExposureTable::measure() {
    compact_ = width() < fontMetrics().averageCharWidth() * kWideChars;
    setColumnHidden(kUsed, compact_);
    verticalHeader()->setDefaultSectionSize(fontMetrics().height() + (compact_ ? 10 : 6));
}

void ExposureTable::resizeEvent(QResizeEvent* event) {
    const bool was = compact_;
    measure();
    if (was != compact_) fill();
    QTableWidget::resizeEvent(event);
}

QTableWidgetItem* ExposureTable::cell(int line, int column, const QString& shown) {
    auto* made = item(line, column);
    if (made == nullptr) {
        made = new QTableWidgetItem;
        if (column > 0) made->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
        setItem(line, column, made);
    }
    if (made->text() != shown) made->setText(shown);
    return made;
}

void ExposureTable::showSection(int line, const QString& title) {
    if (columnSpan(line, kQuantity) == 1) setSpan(line, kQuantity, 1, columnCount());
    auto* made = cell(line, kQuantity, title);
    made->setData(Qt::ForegroundRole, QBrush(colours().quiet));
    made->setToolTip({});
    made->setData(kEvaluated, QVariant());
    cell(line, kUsed, {})->setData(kEvaluated, QVariant());
    for (const int column : {kLimit, kUsed}) cell(line, column, {})->setData(kCopiedTextRole, QVariant());
}

void ExposureTable::showRow(int line, const ExposureRow& row) {
    if (columnSpan(line, kQuantity) != 1) setSpan(line, kQuantity, 1, 1);
    const bool broken = forbids(row);
    const auto title = titled(rowTitle(row));
    auto* quantity = cell(line, kQuantity, title);
    quantity->setToolTip(row.set.empty() ? title : tr("%1, limit of %2").arg(title, titleOfSet(row)));
    quantity->setData(Qt::ForegroundRole, QVariant());
    const auto missing = compact_ ? QString("–") : tr("not evaluated");
    auto* value = cell(line, kValue, row.evaluated ? valueText(row) : missing);
    value->setToolTip(row.evaluated ? measuredText(row) : tr("Not evaluated: %1").arg(qtext(row.reason.view())));
    // An invalid brush selects the palette's colour, which follows the theme.
    value->setData(Qt::ForegroundRole, QVariant());
    auto* limit = cell(line, kLimit, limitText(row, compact_));
    limit->setToolTip(limitText(row));
    limit->setData(kCopiedTextRole, limitText(row));
    // Both cells that can paint the bar get the data, because a cell is repainted only when its own data change.
    const auto share = row.evaluated && !std::isnan(row.limit) ? QVariant(double(row.value / row.limit)) : QVariant();
    for (auto* drawn : {quantity, cell(line, kUsed, QString())}) {
        drawn->setData(kShare, share);
        drawn->setData(kEvaluated, row.evaluated);
        drawn->setData(kBroken, broken);
    }
    cell(line, kUsed, {})
        ->setData(kCopiedTextRole, share.isValid() ? limitShareText(100 * share.toDouble()) : QString());
}

QString ExposureTable::titleOfSet(const ExposureRow& row) const {
    for (const auto& [id, title] : titles_) {
        if (id == row.set.view()) return title;
    }
    return {};
}

void ExposureTable::show(std::span<const ExposureRow> rows, std::span<const LimitSet> sets) {
    rows_.assign(rows.begin(), rows.end());
    titles_.clear();
    for (const auto& row : rows_) {
        if (row.set.empty() || !titleOfSet(row).isEmpty()) continue;
        titles_.emplace_back(row.set.view(), qtext(titleOf(sets, row.set.view())));
    }
    fill();
}

void ExposureTable::fill() {
    int lines = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) lines += i == 0 || !(rows_[i].set == rows_[i - 1].set) ? 2 : 1;
    if (rowCount() != lines) setRowCount(lines);
    int line = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const auto& row = rows_[i];
        if (i == 0 || !(row.set == rows_[i - 1].set))
            showSection(line++, row.set.empty() ? tr("Shown without a limit") : titled(titleOfSet(row)));
        showRow(line++, row);
    }
}

namespace {

constexpr QChar kBeforeUnit(0x202f);
constexpr int kMaxDecimals = 4;  // most decimals used for a value just below its limit

ExposureFigure split(const QString& quantity) {
    const auto end = quantity.indexOf(kBeforeUnit);
    return end < 0 ? ExposureFigure{quantity, {}} : ExposureFigure{quantity.left(end), quantity.mid(end + 1)};
}

QString joined(const ExposureFigure& figure) {
    return figure.unit.isEmpty() ? figure.number : figure.number + kBeforeUnit + figure.unit;
}

/// Returns the value with three digits, and with no more decimals than are useful next to `limit`.
QString numberBeside(double value, double limit, int limitDecimals) {
    if (value == 0) return QStringLiteral("0");
    const int most = limit < 1 ? 3 : limit < 100 ? 2 : 1;
    const double least = std::pow(10.0, -most);
    if (value < least) return "< " + decimalText(least, most);
    const int digits = value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
    const int decimals = std::max(std::min(most, digits == 2 && limit < 1 ? 3 : digits), limitDecimals);
    const auto said = decimalText(value, decimals);
    // A value below its limit must never read as if it had reached the limit.
    for (int finer = decimals; value < limit && finer <= kMaxDecimals; ++finer) {
        if (const auto below = decimalText(value, finer); below.toDouble() < limit) return below;
    }
    return value > limit && !(said.toDouble() > limit) ? "> " + decimalText(limit, limitDecimals) : said;
}

}  // namespace

ExposureFigure figureOf(const ExposureRow& row) {
    const auto unit = qtext(row.unit);
    if (std::isnan(row.limit)) return split(quantityText(row.value, unit, 3));
    const auto limit = split(settingText(row.limit, unit));
    bool isNumber = false;
    const double number = limit.number.toDouble(&isNumber);
    const double share = row.value / row.limit;
    if (!isNumber || !(number > 0) || !std::isfinite(share) || share < 0)
        return split(quantityText(row.value, unit, 3));
    const auto point = limit.number.indexOf('.');
    const int limitDecimals = point < 0 ? 0 : int(limit.number.size() - point - 1);
    return {numberBeside(share * number, number, limitDecimals), limit.unit};
}

QString valueText(const ExposureRow& row) { return joined(figureOf(row)); }

QString valueOfLimitText(const ExposureRow& row) {
    auto limit = split(settingText(row.limit, qtext(row.unit)));
    const auto value = figureOf(row);
    const bool oneUnit = value.unit == limit.unit;
    if (needsArea(row.quantity)) limit.unit.remove(QStringLiteral("/cm²"));
    if (value.number.startsWith('>')) return "> " + joined(limit);
    return QObject::tr("%1 of %2").arg(oneUnit ? value.number : joined(value), joined(limit));
}

QString measuredText(const ExposureRow& row) {
    if (std::isnan(row.measured)) return {};
    auto shown = row;
    shown.value = row.measured;
    // Without the limit, as "> 40 V" would not say how far above the limit the value is.
    shown.limit = std::nan("");
    return (row.beyond ? QObject::tr("⚠ %1 measured") : QObject::tr("%1 measured")).arg(valueText(shown));
}

}  // namespace tacto::gui

#include "moc_ExposureTable.cpp"
