#include "app/gui/runner/LoadRows.h"

#include <QHeaderView>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/VerdictBlock.h"
#include "app/report/TableContent.h"
#include "core/base/JsonText.h"
#include "core/electrode/Load.h"

namespace tacto::gui {

namespace {

constexpr int kVerdictRole = Qt::UserRole;
constexpr int kCountRole = Qt::UserRole + 1;
constexpr int kNameRole = Qt::UserRole + 2;  // the text that parseLoad() reads

QString number(const nlohmann::json& values, const char* key, const char* unit) {
    return quantityText(numberOr(values, key), unit);
}

}  // namespace

LoadRows::LoadRows(QWidget* parent) : QTableWidget(0, kColumns, parent) {
    nameWidget(*this, "loadRows", tr("Loads"),
               tr("Each load of the bench set: its value as measured, the strongest output so far, and its verdict."));
    setHorizontalHeaderLabels(
        {tr("Load"), tr("Verdict"), tr("Measured"), tr("Commands"), tr("Peak current"), tr("RMS, 5 s")});
    makeReadOnly(*this);
    setAlternatingRowColors(true);
    setWordWrap(false);
    setHorizontalScrollMode(ScrollPerPixel);
    begin();
    onLookChange(*this, [this] { colour(); });
    afterLookChange(*this, [this] { fit(); });
}

void LoadRows::begin() {
    setRowCount(0);
    for (const auto& named : benchLoads()) {
        const int row = rowOf(QString::fromUtf8(named.name.data(), qsizetype(named.name.size())));
        write(row, kVerdict, tr("○ to do"));
    }
    fit();
}

int LoadRows::rowOf(const QString& load) {
    for (int row = 0; row < rowCount(); ++row) {
        if (item(row, kLoad)->data(kNameRole).toString() == load) return row;
    }
    const int row = rowCount();
    insertRow(row);
    for (int column = 0; column < kColumns; ++column) {
        auto* cell = new QTableWidgetItem(column == kLoad      ? (load.contains("||") ? tr("skin RC") : loadText(load))
                                          : column == kVerdict ? QString()
                                                               : QString("–"));
        const bool right = column != kLoad && column != kVerdict;
        cell->setTextAlignment((right ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
        setItem(row, column, cell);
    }
    item(row, kLoad)->setData(kNameRole, load);
    item(row, kLoad)->setToolTip(loadText(load));
    return row;
}

void LoadRows::write(int row, Column column, const QString& text) { item(row, column)->setText(text); }

void LoadRows::numbers(int row, const nlohmann::json& values, const char* measured) {
    write(row, kMeasured, number(values, measured, "Ω"));
    write(row, kPeak, number(values, "peak_ma", "mA"));
    write(row, kRms, number(values, "rms_5s_ma", "mA"));
}

void LoadRows::judge(int row, const QString& verdict) {
    auto* cell = item(row, kVerdict);
    cell->setData(kVerdictRole, verdict);
    cell->setText(verdictText(verdict));
    cell->setForeground(verdictStyle(verdict).colour);
}

void LoadRows::add(const nlohmann::json& trial) {
    const auto textOf = [&trial](const char* key) {
        const auto& value = memberAt(trial, key);
        return value.is_string() ? value.get<std::string>() : std::string();
    };
    const auto type = textOf("type");
    if (type != "command" && type != "load") return;
    const int row = rowOf(QString::fromStdString(textOf("load")));
    scrollToItem(item(row, kLoad));
    if (type == "load") {
        numbers(row, trial, "measured_ohm");
        judge(row, QString::fromStdString(textOf("verdict")));
    } else {
        const int count = item(row, kCommands)->data(kCountRole).toInt() + 1;
        item(row, kCommands)->setData(kCountRole, count);
        write(row, kCommands, QString::number(count));
        numbers(row, trial, "impedance_ohm");
        write(row, kVerdict, tr("◔ being measured"));
    }
    fit();
}

void LoadRows::end(const nlohmann::json& results) {
    for (const auto& line : memberAt(results, "loads")) {
        if (!line.is_object()) continue;
        const int row = rowOf(QString::fromStdString(line.value("name", std::string())));
        numbers(row, line, "measured_ohm");
        judge(row, QString::fromStdString(line.value("verdict", std::string("not evaluated"))));
    }
    for (int row = 0; row < rowCount(); ++row) {
        if (item(row, kVerdict)->data(kVerdictRole).toString().isEmpty()) judge(row, "not evaluated");
    }
    fit();
}

QString LoadRows::verdictOf(const QString& load) const {
    for (int row = 0; row < rowCount(); ++row) {
        if (item(row, kLoad)->data(kNameRole).toString() == load) return item(row, kVerdict)->text();
    }
    return {};
}

void LoadRows::fit() {
    verticalHeader()->setDefaultSectionSize(fontMetrics().height() * 3 / 2);
    resizeColumnsToContents();
}

void LoadRows::colour() {
    for (int row = 0; row < rowCount(); ++row) {
        auto* cell = item(row, kVerdict);
        if (const auto verdict = cell->data(kVerdictRole).toString(); !verdict.isEmpty())
            cell->setForeground(verdictStyle(verdict).colour);
    }
}

}  // namespace tacto::gui

#include "moc_LoadRows.cpp"
