#include "app/gui/window/ExposureDock.h"

#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

constexpr int kShare = Qt::UserRole;          // double, NaN without a limit or a value
constexpr int kEvaluated = Qt::UserRole + 1;  // bool

/// The last column: how much of the limit is used.
class ShareDelegate final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;
    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const auto& c = colours();
        const double share = index.data(kShare).toDouble();
        const QRectF frame =
            QRectF(option.rect).adjusted(3.5, option.rect.height() * 0.3, -3.5, -option.rect.height() * 0.3);
        painter->save();
        painter->setPen(QPen(option.palette.color(QPalette::Mid), 1));
        if (!index.data(kEvaluated).toBool()) {
            painter->setBrush(QBrush(c.quiet, Qt::BDiagPattern));
            painter->drawRect(frame);
        } else if (!std::isnan(share)) {
            painter->setBrush(option.palette.color(QPalette::Midlight));
            painter->drawRect(frame);
            painter->setPen(Qt::NoPen);
            painter->setBrush(share > 1 ? c.fault : share >= 0.8 ? c.amber : c.accent);
            painter->drawRect(
                QRectF(frame.topLeft(), QSizeF(frame.width() * std::clamp(share, 0.0, 1.0), frame.height())));
        }
        painter->restore();
    }
};

QString words(std::string_view text) { return QString::fromUtf8(text.data(), qsizetype(text.size())); }

}  // namespace

ExposureDock::ExposureDock(QWidget* parent) : QDockWidget(tr("Exposure"), parent) {
    setObjectName("exposureDock");
    table_ = new QTableWidget(0, 4, this);
    table_->setAccessibleName(tr("Exposure against limits"));
    table_->setHorizontalHeaderLabels({tr("Quantity"), tr("Value"), tr("Limit"), tr("Used")});
    table_->verticalHeader()->hide();
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setWordWrap(false);
    table_->setItemDelegateForColumn(3, new ShareDelegate(table_));
    auto* header = table_->horizontalHeader();
    header->setSectionResizeMode(0, QHeaderView::Stretch);
    for (const int column : {1, 2}) header->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    header->setSectionResizeMode(3, QHeaderView::Interactive);
    header->resizeSection(3, table_->fontMetrics().horizontalAdvance("not evaluated"));
    table_->setToolTip(
        tr("Worst case over the permitted load range, exposure of the last 5 s included. Hatched: not "
           "evaluated, and never a pass."));
    setWidget(table_);
}

void ExposureDock::refresh(const Telemetry& telemetry) {
    const auto rows = telemetry.exposure();
    if (telemetry.at == shownAt_ && table_->rowCount() == int(rows.size())) return;
    shownAt_ = telemetry.at;
    if (table_->rowCount() != int(rows.size())) table_->setRowCount(int(rows.size()));
    for (int i = 0; i < int(rows.size()); ++i) {
        const auto& row = rows[std::size_t(i)];
        const auto unit = words(row.unit);
        auto name = words(titleOf(row.quantity));
        if (row.judged == JudgedAt::Ohm500) name += tr(" into 500 Ω");
        const auto cell = [&](int column, const QString& text) {
            auto* item = table_->item(i, column);
            if (item == nullptr) {
                item = new QTableWidgetItem;
                if (column > 0) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
                table_->setItem(i, column, item);
            }
            if (item->text() != text) item->setText(text);
            return item;
        };
        cell(0, name)->setToolTip(row.set.empty() ? name : tr("%1, limit of %2").arg(name, words(row.set.view())));
        auto* value = cell(1, row.evaluated ? quantityText(row.value, unit, 3) : tr("not evaluated"));
        value->setToolTip(row.evaluated ? QString() : words(row.reason.view()));
        value->setForeground(row.evaluated && !row.within ? colours().fault : palette().color(QPalette::Text));
        cell(2, std::isnan(row.limit) ? QString("–") : (row.strict ? "< " : "≤ ") + settingText(row.limit, unit));
        auto* share = cell(3, QString());
        share->setData(kShare, row.evaluated && !std::isnan(row.limit) ? row.value / row.limit : std::nan(""));
        share->setData(kEvaluated, row.evaluated);
    }
}

}  // namespace tacto::gui
