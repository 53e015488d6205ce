#include "app/gui/look/ExposureTable.h"

#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

constexpr int kShare = Qt::UserRole;          // double, NaN without a limit or a value
constexpr int kEvaluated = Qt::UserRole + 1;  // bool
constexpr int kBroken = Qt::UserRole + 2;     // bool: a limit that refuses is not kept

class BarDelegate final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;
    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const auto& c = colours();
        const double share = index.data(kShare).toDouble();
        const double inset = option.rect.height() * 0.3;
        const QRectF frame = QRectF(option.rect).adjusted(3.5, inset, -3.5, -inset);
        painter->save();
        painter->setPen(QPen(option.palette.color(QPalette::Mid), 1));
        if (!index.data(kEvaluated).toBool()) {
            painter->setBrush(QBrush(c.quiet, Qt::BDiagPattern));
            painter->drawRect(frame);
        } else if (!std::isnan(share)) {
            painter->setBrush(option.palette.color(QPalette::Midlight));
            painter->drawRect(frame);
            painter->setPen(Qt::NoPen);
            painter->setBrush(index.data(kBroken).toBool() ? c.fault : share >= 0.8 ? c.amber : c.accent);
            painter->drawRect(
                QRectF(frame.left(), frame.top(), frame.width() * std::clamp(share, 0.0, 1.0), frame.height()));
        }
        painter->restore();
    }
};

}  // namespace

QString text(std::string_view utf8) { return QString::fromUtf8(utf8.data(), qsizetype(utf8.size())); }

QString rowTitle(const ExposureRow& row) {
    const auto title = text(titleOf(row.quantity));
    return row.judged == JudgedAt::Ohm500 ? QObject::tr("%1 into 500 Ω").arg(title) : title;
}

QString limitText(const ExposureRow& row, bool compact) {
    if (std::isnan(row.limit)) return "–";
    const auto limit = (row.strict ? QString("< ") : QString("≤ ")) + settingText(row.limit, text(row.unit));
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

ExposureTable::ExposureTable(QWidget* parent) : QTableWidget(0, 4, parent) {
    setHorizontalHeaderLabels({tr("Quantity"), tr("Value"), tr("Limit"), tr("Used")});
    verticalHeader()->hide();
    setEditTriggers(QAbstractItemView::NoEditTriggers);
    setSelectionBehavior(QAbstractItemView::SelectRows);
    setWordWrap(false);
    setItemDelegateForColumn(3, new BarDelegate(this));
    auto* header = horizontalHeader();
    header->setSectionResizeMode(0, QHeaderView::Stretch);
    for (const int column : {1, 2}) header->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    header->resizeSection(3, fontMetrics().horizontalAdvance("not eval"));
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 8);
}

void ExposureTable::show(std::span<const ExposureRow> rows) {
    if (rowCount() != int(rows.size())) setRowCount(int(rows.size()));
    for (int i = 0; i < int(rows.size()); ++i) {
        const auto& row = rows[std::size_t(i)];
        const auto cell = [&](int column, const QString& shown) {
            auto* made = item(i, column);
            if (made == nullptr) {
                made = new QTableWidgetItem;
                if (column > 0) made->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
                setItem(i, column, made);
            }
            if (made->text() != shown) made->setText(shown);
            return made;
        };
        const bool broken = row.evaluated && !row.within && row.action == LimitAction::Refuse;
        const auto title = rowTitle(row);
        cell(0, title)->setToolTip(row.set.empty() ? title : tr("%1, limit of %2").arg(title, text(row.set.view())));
        auto* value = cell(1, row.evaluated ? quantityText(row.value, text(row.unit), 3) : tr("not evaluated"));
        value->setToolTip(row.evaluated ? QString() : text(row.reason.view()));
        // Else the palette's own, which follows the theme.
        value->setData(Qt::ForegroundRole, broken ? QVariant(QBrush(colours().fault)) : QVariant());
        cell(2, limitText(row, compact_))->setToolTip(limitText(row));
        auto* bar = cell(3, QString());
        bar->setData(kShare, row.evaluated && !std::isnan(row.limit) ? row.value / row.limit : std::nan(""));
        bar->setData(kEvaluated, row.evaluated);
        bar->setData(kBroken, broken);
    }
}

}  // namespace tacto::gui
