#include "app/gui/runner/LimitMatrixView.h"

#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>
#include <cmath>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/TableText.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/VerdictBlock.h"
#include "app/report/NumberText.h"
#include "app/report/ResultCells.h"
#include "core/base/JsonText.h"
namespace tacto::gui {

namespace {

using nlohmann::json;

constexpr int kCellVerdict = Qt::UserRole;    // "pass", ...; none if not judged
constexpr int kCellShare = Qt::UserRole + 1;  // "23 %"
constexpr int kCellNear = Qt::UserRole + 2;   // true if 80 % or more of the limit is used
constexpr int kLineNote = Qt::UserRole;       // the text below a limit's title
constexpr int kLineUnit = Qt::UserRole + 3;   // the limit's unit
constexpr int kRow = 36, kHighRow = 44, kIconSize = 14, kPad = 8, kHeaderPad = 5;
constexpr int kLimitChars = 30, kLoadChars = 9;
const QString kNoteParts = QStringLiteral(" · ");

QString wordsOf(const json& value) {
    return value.is_string() ? visible(QString::fromStdString(value.get<std::string>())) : QString();
}

/// Draws the limit's title, and below it the value, owner and verdict of the limit.
class LimitDelegate final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;
    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const auto& c = colours();
        painter->save();
        const auto area = option.rect.adjusted(kPad, 0, -kPad, 0);
        const auto line = [&](const QString& text, TextSize size, const QColor& ink, bool lower) {
            painter->setFont(textFont(size));
            painter->setPen(ink);
            const auto half =
                QRect(area.left(), area.top() + (lower ? area.height() / 2 : 0), area.width(), area.height() / 2);
            const int down = lower ? Qt::AlignTop : Qt::AlignBottom;
            painter->drawText(half, down | Qt::AlignLeft,
                              painter->fontMetrics().elidedText(text, Qt::ElideRight, half.width()));
        };
        line(index.data().toString(), TextSize::Body, c.text, false);
        auto note = index.data(kLineNote).toString();
        // Where there is little room, the verdict is left to the row's cells.
        if (QFontMetrics(textFont(TextSize::Small)).horizontalAdvance(note) > area.width())
            note = note.section(kNoteParts, 1);
        line(note, TextSize::Small, c.quiet, true);
        painter->setPen(c.grid);
        painter->drawLine(option.rect.bottomLeft(), option.rect.bottomRight());
        painter->restore();
    }
};

struct CellStyle {
    QColor ground, ink;
};

CellStyle styleOf(const QString& verdict, bool isNear) {
    const auto& c = colours();
    if (verdict == "fail") return {c.fail, c.failText};
    if (verdict == "attention") return {c.amber, c.amberInk};
    if (verdict == "indeterminate" || verdict == "refused as expected" || (verdict == "pass" && isNear))
        return {c.amberCell, c.amberText};
    if (verdict == "pass") return {c.passCell, c.text};
    return {c.base, c.quiet};
}

bool isAsked(const QString& verdict) { return !verdict.isEmpty() && verdict != "not applicable"; }

/// True if the cell has room for the largest share with its per cent sign; if not, the header shows the sign.
bool isRoomy(int cellWidth) {
    const QFontMetrics metrics(textFont(TextSize::Small, QFont::DemiBold));
    return cellWidth >= scaledPx(kIconSize) + kPad + metrics.horizontalAdvance("100\u202f%") + 4;
}

QString bareShare(const QModelIndex& index) { return index.data(kCellShare).toString().remove("\u202f%"); }

QFontMetrics cellMetrics() { return QFontMetrics(textFont(TextSize::Small, QFont::DemiBold)); }

/// Returns the width of shape and share side by side.
int besideWidth(const QString& share) { return scaledPx(kIconSize) + 4 + cellMetrics().horizontalAdvance(share); }

/// Returns the header, split into two lines if too long for its column: "100", and "kΩ" below it.
QString headerText(const QString& load, int columnWidth) {
    auto text = load;
    const QFontMetrics metrics(textFont(TextSize::Small));
    if (metrics.horizontalAdvance(text) + scaledPx(kHeaderPad) <= columnWidth) return text;
    return text.replace(' ', '\n').replace(QChar(0x00a0), '\n');
}

/// Returns the smallest header width, with headers in two lines.
int leastHeaderWidth(const QStringList& loads) {
    const QFontMetrics metrics(textFont(TextSize::Small));
    int widest = 0;
    for (const auto& load : loads)
        for (const auto& word : headerText(load, 0).split('\n'))
            widest = std::max(widest, metrics.horizontalAdvance(word));
    return widest + scaledPx(kHeaderPad);
}

class CellDelegate final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;
    /// Returns the smallest size in which the cell can be painted: the share below the shape.
    [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const auto metrics = cellMetrics();
        const int share = metrics.horizontalAdvance(bareShare(index)) + 4;
        if (!isAsked(index.data(kCellVerdict).toString())) return {share, metrics.height() + 4};
        if (besideWidth(bareShare(index)) <= option.rect.width()) return {share, metrics.height() + 4};
        return {share, scaledPx(kIconSize) + metrics.height() + 4};
    }
    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const auto& c = colours();
        const auto verdict = index.data(kCellVerdict).toString();
        const auto style = styleOf(verdict, index.data(kCellNear).toBool());
        painter->save();
        const auto cell = option.rect.adjusted(1, 1, -1, -1);
        const bool isNear = index.data(kCellNear).toBool();
        paintCellGround(*painter, cell, verdict, isNear);
        const bool asked = isAsked(verdict);
        painter->setFont(textFont(TextSize::Small, asked ? QFont::DemiBold : QFont::Normal));
        const int size = scaledPx(kIconSize);
        const bool room = isRoomy(cell.width());
        const int pad = room ? kPad / 2 : 1;
        const auto text = room ? index.data(kCellShare).toString() : bareShare(index);
        const bool below = asked && besideWidth(text) > option.rect.width();
        // Shape and share together are centred vertically.
        const int high = painter->fontMetrics().height();
        const auto lines = below ? cell.adjusted(0, std::max(0, (cell.height() - size - high) / 2), 0, 0) : cell;
        if (asked) {
            const QRect place = below ? QRect(lines.left(), lines.top(), lines.width(), size)
                                      : QRect(cell.left() + pad, cell.top(), size, cell.height());
            paintCellShape(*painter, place, verdict, isNear, size);
        }
        painter->setPen(style.ink);
        const auto place =
            below ? QRect(lines.left(), lines.top() + size, lines.width(), high) : cell.adjusted(0, 0, -pad, 0);
        const int where = int(asked && !below ? Qt::AlignRight : Qt::AlignHCenter) | Qt::AlignVCenter;
        if (verdict == "not evaluated") {
            // The words get a plain background so that they stay readable on the hatch.
            const auto words = painter->fontMetrics().boundingRect(place, where, text);
            painter->fillRect(words.adjusted(-2, 0, 2, 0), style.ground);
        }
        painter->drawText(place, where, text);
        if ((option.state & (QStyle::State_HasFocus | QStyle::State_Selected)) != 0) {
            painter->setPen(QPen(c.text, 2));
            painter->drawRect(cell.adjusted(1, 1, -1, -1));
        }
        painter->restore();
    }
};

}  // namespace

void paintCellGround(QPainter& painter, const QRect& cell, const QString& verdict, bool isNear) {
    painter.fillRect(cell, styleOf(verdict, isNear).ground);
    if (verdict == "not evaluated") painter.fillRect(cell, QBrush(colours().hatch, Qt::BDiagPattern));
}

void paintCellShape(QPainter& painter, const QRect& place, const QString& verdict, bool isNear, int size) {
    const auto ink = verdict == "pass" && !isNear ? colours().passText : styleOf(verdict, isNear).ink;
    if (!isAsked(verdict)) {
        painter.setPen(ink);
        painter.drawText(place, Qt::AlignCenter, "–");
        return;
    }
    painter.drawPixmap(place.center() - QPoint(size / 2, size / 2 - 1),
                       iconPixmap(verdictStyle(verdict).icon, ink, size, painter.device()->devicePixelRatioF()));
}

LimitMatrixView::LimitMatrixView(QWidget* parent) : QTableWidget(parent) {
    nameWidget(
        *this, "limitMatrix", tr("Limits on each load"),
        tr("How much of each limit is used on each load, uncertainty included. ✔ inside, amber from 80 %; ▲ attention; "
           "? indeterminate; ✖ exceeded; hatched, n. e.: not evaluated, and never a pass; –: not judged on this load. "
           "A chosen cell shows the strongest train on its load."));
    makeReadOnly(*this);
    setHorizontalScrollMode(ScrollPerPixel);
    setVerticalScrollMode(ScrollPerPixel);
    setItemDelegate(new CellDelegate(this));
    setItemDelegateForColumn(0, new LimitDelegate(this));
    connect(this, &QTableWidget::currentCellChanged, this, &LimitMatrixView::choose);
    auto* header = horizontalHeader();
    header->setHighlightSections(false);
    header->setSectionsClickable(false);
    setTextSize(*header, TextSize::Small);
    afterLookChange(*this, [this] {
        fitColumns();
        viewport()->update();
    });
}

void LimitMatrixView::show(const json& matrix) {
    shown_ = matrix;
    clear();
    loads_.clear();
    loadKeys_.clear();
    setRowCount(0);
    setColumnCount(0);
    const auto limits = limitsOf(matrix);
    if (limits.rows.empty()) return;
    QStringList header{QString()};
    for (qsizetype c = 0; c < limits.columns.size(); ++c) {
        const auto name = limits.columns[c];
        loads_.push_back(name);
        loadKeys_.push_back(wordsOf(memberAt(matrix, "loads")[std::size_t(c)]));
        header << (name.contains(QChar(0x2225)) ? tr("skin RC") : name);
    }
    setColumnCount(int(header.size()));
    setHorizontalHeaderLabels(header);
    headings_ = header;
    horizontalHeaderItem(0)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    horizontalHeaderItem(0)->setData(kCopiedTextRole, tr("Limit"));
    for (int c = 1; c < columnCount(); ++c) {
        const auto& load = loads_[std::size_t(c) - 1];
        horizontalHeaderItem(c)->setToolTip(load);
        horizontalHeaderItem(c)->setData(kCopiedTextRole, load);
    }
    setRowCount(int(limits.rows.size()));
    for (int row = 0; row < rowCount(); ++row) addLine(row, limits.rows[std::size_t(row)]);
    fitColumns();
}

Still LimitMatrixView::picture(PictureCaption caption) const {
    LimitMatrixView whole;
    whole.setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    whole.show(shown_);
    whole.ensurePolished();
    whole.resize(width(), whole.heightOf(rowCount()));
    caption.lines << tr(
        "Share of each limit used, with U. ✔ inside, ? indeterminate, ✖ exceeded, n. e. not evaluated.");
    return {whole, std::move(caption)};
}

int LimitMatrixView::heightOf(int rows) const {
    return 2 * frameWidth() + horizontalHeader()->height() + rows * scaledPx(kRow);
}

void LimitMatrixView::choose(int row, int column) {
    if (row < 0 || column < 1 || item(row, 0) == nullptr) return;
    emit chosen(item(row, 0)->text(), loadKeys_[std::size_t(column) - 1], item(row, 0)->data(kLineUnit).toString());
}

void LimitMatrixView::addLine(int row, const MatrixBlock::Row& line) {
    auto* head = new QTableWidgetItem(line.name);
    head->setData(kLineUnit, line.unit);
    head->setData(kLineNote, verdictCell(line.verdict) + kNoteParts + line.note);
    head->setData(kCopiedTextRole, line.name + ", " + head->data(kLineNote).toString());
    head->setToolTip(QStringList{line.name, line.limit, line.set, line.source, line.verdict}.join(" · "));
    setItem(row, 0, head);
    for (int c = 1; c < columnCount(); ++c) {
        const auto& cell = line.cells[std::size_t(c) - 1];
        const auto& load = loads_[std::size_t(c) - 1];
        auto* item = new QTableWidgetItem("–");
        setItem(row, c, item);
        item->setData(kCellShare, QString("–"));
        if (cell.state == MatrixBlock::State::Empty) {
            item->setToolTip(tr("%1 is not judged on %2.").arg(line.name, load));
            continue;
        }
        item->setText(verdictShape(cell.verdict) + " " + cell.share);
        item->setData(kCellVerdict, cell.verdict);
        item->setData(kCellShare, cell.share);
        item->setData(kCellNear, cell.isNear);
        const bool timed = !line.hasLimit && cell.hasShare;
        QStringList says{
            line.hasLimit ? tr("%1 on %2: %3 of %4 (%5).").arg(line.name, load, cell.measured, line.limit, line.set)
            : timed       ? tr("%1 on %2: %3.").arg(line.name, load, cell.note)
            : cell.verdict == "pass" ? tr("%1 on %2: after %3, %4.").arg(line.name, load, cell.measured, line.limit)
                                     : tr("%1 on %2: not shown to be %3.").arg(line.name, load, line.limit)};
        if (cell.hasShare)
            says << (timed ? tr("At most %1 of that time.") : tr("%1 used, with its uncertainty.")).arg(cell.share);
        says << tr("Verdict: %1.").arg(cell.verdict) << (timed ? QString() : cell.note);
        item->setToolTip(says.join(' ').trimmed());
        item->setData(Qt::AccessibleTextRole, item->toolTip());
    }
}

void LimitMatrixView::setFillsHeight(bool fills) {
    if (std::exchange(fillsHeight_, fills) != fills) fitColumns();
}

/// If not all rows fit, whole rows fill the height, so that none is cut at the lower edge.
void LimitMatrixView::fitRows() {
    const int room = height() - heightOf(0), least = scaledPx(kRow);
    const int inSight = std::clamp(room / least, 1, std::max(1, rowCount()));
    const bool scrolls = inSight < rowCount();
    const int most = fillsHeight_ || scrolls ? scaledPx(kHighRow) : least;
    const int each = std::clamp(room / inSight, least, most);
    verticalHeader()->setDefaultSectionSize(each);
    const int left = scrolls && room > least ? room % inSight : 0;
    for (int row = 0; row < rowCount(); ++row) setRowHeight(row, each + (row % inSight < left ? 1 : 0));
}

void LimitMatrixView::fitColumns() {
    horizontalHeader()->setFixedHeight(2 * QFontMetrics(textFont(TextSize::Small)).height() + kPad);
    fitRows();
    setMaximumHeight(fillsHeight_ ? QWIDGETSIZE_MAX : heightOf(rowCount()));  // leaves the rest to the tracing
    if (columnCount() < 2) return;
    auto* header = horizontalHeader();
    const int loads = columnCount() - 1;
    const int chars = fontMetrics().averageCharWidth();
    // Load columns share the width left by the limits column, and are never wider than their headings need.
    const int least = chars * kLoadChars / 2;
    int first = std::min(chars * kLimitChars * 2, std::max(chars * kLimitChars, viewport()->width() / 4));
    const int words = leastHeaderWidth(headings_);
    if ((viewport()->width() - first) / loads < words)
        first = std::max(chars * kLimitChars * 2 / 3, viewport()->width() - words * loads);
    const int each = std::clamp((viewport()->width() - first) / loads, std::max(least, words), chars * kLoadChars * 2);
    // If space is very short, limit titles are elided and the load columns scroll.
    const bool scrolls = first + each * loads > viewport()->width();
    if (scrolls) first = std::max(chars * kLimitChars / 2, viewport()->width() - each * loads);
    header->setSectionResizeMode(0, scrolls ? QHeaderView::Fixed : QHeaderView::Stretch);
    if (scrolls) header->resizeSection(0, first);
    const auto unit = isRoomy(each - 2) ? QString() : tr(" in %");
    horizontalHeaderItem(0)->setText(tr("Limit, worst first\nshare used%1, with U").arg(unit));
    for (int c = 1; c < columnCount(); ++c) {
        header->setSectionResizeMode(c, QHeaderView::Fixed);
        header->resizeSection(c, each);
        horizontalHeaderItem(c)->setText(headerText(headings_[c], each));
    }
}

void LimitMatrixView::resizeEvent(QResizeEvent* event) {
    QTableWidget::resizeEvent(event);
    fitColumns();
}

namespace {

constexpr int kSampleWide = 24, kSampleHigh = 18, kRowHigh = 22, kBesideSample = 8, kAbove = 10, kBelowTitle = 8;
constexpr int kSampleIcon = 14;

}  // namespace

CellLegend::CellLegend(QWidget* parent)
    : QWidget(parent),
      kinds_{{"pass", false, tr("inside, uncertainty included")},
             {"pass", true, tr("inside, 80\u202f% or more used")},
             {"refused as expected", false, tr("also asked above: refused")},
             {"attention", false, tr("attention, not a failure")},
             {"indeterminate", false, tr("indeterminate")},
             {"fail", false, tr("exceeded")},
             {"not evaluated", false, tr("n.\u00a0e.: not evaluated")},
             {{}, false, tr("not judged on this load")}} {
    QStringList said;
    for (const auto& kind : kinds_) said << kind.words;
    setAccessibleName(tr("How to read a cell"));
    setAccessibleDescription(said.join("; "));
}

QSize CellLegend::sizeHint() const {
    const int title = QFontMetrics(textFont(TextSize::Small, QFont::DemiBold)).height();
    return {0, scaledPx(kAbove) + title + scaledPx(kBelowTitle) + int(kinds_.size()) * scaledPx(kRowHigh)};
}

void CellLegend::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    const auto& c = colours();
    painter.setPen(c.line);
    painter.drawLine(0, 0, width(), 0);
    painter.setFont(textFont(TextSize::Small, QFont::DemiBold));
    painter.setPen(c.text);
    QRect line(0, scaledPx(kAbove), width(), painter.fontMetrics().height());
    painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, tr("How to read a cell"));
    line = QRect(0, line.bottom() + 1 + scaledPx(kBelowTitle), width(), scaledPx(kRowHigh));
    painter.setFont(textFont(TextSize::Small));
    const int left = scaledPx(kSampleWide) + kBesideSample;
    for (const auto& kind : kinds_) {
        const QRect sample(0, line.top(), scaledPx(kSampleWide), scaledPx(kSampleHigh));
        paintCellGround(painter, sample, kind.verdict, kind.isNear);
        paintCellShape(painter, sample, kind.verdict, kind.isNear, scaledPx(kSampleIcon));
        painter.setPen(c.text);
        painter.drawText(QRect(left, sample.top(), width() - left, sample.height()), Qt::AlignLeft | Qt::AlignVCenter,
                         painter.fontMetrics().elidedText(kind.words, Qt::ElideRight, width() - left));
        line.translate(0, line.height());
    }
}

}  // namespace tacto::gui

#include "moc_LimitMatrixView.cpp"
