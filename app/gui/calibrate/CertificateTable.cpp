#include "app/gui/calibrate/CertificateTable.h"

#include <QHeaderView>
#include <array>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

enum CertificateColumn {
    kStanding,
    kDevice,
    kSerial,
    kNumber,
    kLab,
    kDate,
    kDue,
    kFirstU,
    kCertificateColumns = kFirstU + 4
};

/// What goes first where there is no room for every column; the tool tip of a row tells all of it.
constexpr std::array kDroppedFirst{int(kLab),    kFirstU + 3, kFirstU + 2, int(kDate),
                                   int(kDevice), kFirstU + 1, int(kFirstU)};
constexpr int kMaxRows = 8;  // in sight; more scroll
constexpr int kIndexRole = Qt::UserRole;
constexpr int kStandsRole = Qt::UserRole + 1;  // not withdrawn

QString markOf(CertificateState state) {
    switch (state) {
        case CertificateState::Counts:
            return "✔ ";
        case CertificateState::Expired:
        case CertificateState::NotYet:
            return "⚠ ";
        case CertificateState::Superseded:
        case CertificateState::Withdrawn:
            break;
    }
    return "– ";
}

Qt::Alignment alignmentOf(int column) {
    return (column >= kFirstU ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter;
}

}  // namespace

QString figureTitle(const CertificateFigure& figure) {
    return QObject::tr("U %1 (%2)").arg(qtext(figure.title), qtext(figure.unit));
}

CertificateTable::CertificateTable(QWidget* parent) : QTableWidget(0, kCertificateColumns, parent) {
    setObjectName("certificates");
    setAccessibleName(QObject::tr("Certificates"));
    setToolTip(
        QObject::tr("Every certificate that was entered. The one with the latest date is in use; what is entered "
                    "cannot be changed without being noticed."));
    QStringList titles{QObject::tr("State"),       QObject::tr("Instrument"), QObject::tr("Serial"),
                       QObject::tr("Certificate"), QObject::tr("Laboratory"), QObject::tr("Date"),
                       QObject::tr("Due")};
    for (const auto& figure : kCertificateFigures) titles << figureTitle(figure);
    for (int c = kFirstU; c < kCertificateColumns; ++c) titles[c].replace(titles[c].indexOf(' ', 2), 1, '\n');
    setHorizontalHeaderLabels(titles);
    for (int c = 0; c < kCertificateColumns; ++c) horizontalHeaderItem(c)->setTextAlignment(alignmentOf(c));
    setTextSize(*horizontalHeader(), TextSize::Small);
    // Two lines: a title and its unit.
    horizontalHeader()->setMinimumHeight(2 * QFontMetrics(textFont(TextSize::Small)).lineSpacing() + scaledPx(8));
    // As high as its rows are, and no higher than a few.
    setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Maximum);
    setMaximumHeight(kMaxRows * verticalHeader()->defaultSectionSize());
    verticalHeader()->hide();
    setEditTriggers(QAbstractItemView::NoEditTriggers);
    setSelectionBehavior(QAbstractItemView::SelectRows);
    setSelectionMode(QAbstractItemView::SingleSelection);
    setAlternatingRowColors(true);
    setWordWrap(false);
    setTabKeyNavigation(false);
    setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    horizontalHeader()->setStretchLastSection(true);  // its lines reach the edge
}

void CertificateTable::show(const CertificateStore& store, CalibrationDate today) {
    setRowCount(0);
    for (std::size_t i = store.all().size(); i-- > 0;) {  // the newest entry first
        const auto& [certificate, entered, withdrawn] = store.all()[i];
        const auto state = store.state(i, today);
        QStringList cells{markOf(state) + qtext(nameOf(state)),
                          qtext(certificate.instrument),
                          qtext(certificate.serial),
                          qtext(certificate.number),
                          qtext(certificate.by),
                          qtext(dateText(certificate.date)),
                          qtext(dateText(certificate.due))};
        for (const auto& figure : kCertificateFigures) {
            const auto& u = certificate.*figure.member;
            cells << (u ? QString::number(*u, 'g', 6) : QString("–"));
        }
        QStringList whole;
        for (int column = 0; column < kCertificateColumns; ++column)
            whole << QString("%1: %2").arg(horizontalHeaderItem(column)->text().simplified(), cells[column]);
        const int row = rowCount();
        insertRow(row);
        for (int column = 0; column < kCertificateColumns; ++column) {
            auto* item = new QTableWidgetItem(cells[column]);
            item->setTextAlignment(alignmentOf(column));
            // What is not used is greyed, and its state says so in words. The window's grey: under the program's style
            // sheet a table's palette has another.
            if (state != CertificateState::Counts)
                item->setForeground(window()->palette().brush(QPalette::PlaceholderText));
            item->setToolTip(whole.join('\n'));
            item->setData(kIndexRole, int(i));
            item->setData(kStandsRole, !withdrawn.has_value());
            setItem(row, column, item);
        }
    }
    fitColumns();
    updateGeometry();
}

void CertificateTable::fitColumns() {
    for (int column = 0; column < kCertificateColumns; ++column) setColumnHidden(column, false);
    horizontalHeader()->setStretchLastSection(false);  // a stretched one would be as wide as the rest
    resizeColumnsToContents();
    for (const int column : kDroppedFirst) {
        if (horizontalHeader()->length() <= viewport()->width()) break;
        setColumnHidden(column, true);
    }
    horizontalHeader()->setStretchLastSection(true);
}

int CertificateTable::chosen() const {
    const auto rows = selectionModel()->selectedRows();
    if (rows.isEmpty()) return -1;
    const auto* cell = item(rows.front().row(), kStanding);
    return cell->data(kStandsRole).toBool() ? cell->data(kIndexRole).toInt() : -1;
}

QString CertificateTable::chosenNumber() const {
    return chosen() < 0 ? QString() : item(currentRow(), kNumber)->text();
}

}  // namespace tacto::gui
