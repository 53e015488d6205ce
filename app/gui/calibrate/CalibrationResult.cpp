#include "app/gui/calibrate/CalibrationResult.h"

#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/calibrate/CalibrationReadings.h"
#include "app/gui/look/TableText.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

using nlohmann::json;

double numberIn(const json& in, const char* key) {
    const auto at = in.find(key);
    return at != in.end() && at->is_number() ? at->get<double>() : std::nan("");
}

QString countIn(const json& in, const char* key) {
    const double count = numberIn(in, key);
    return std::isnan(count) ? QString("–") : QString::number(count);
}

QString words(const json& in, const char* key) {
    const auto at = in.find(key);
    return at != in.end() && at->is_string() ? QString::fromStdString(at->get<std::string>()) : QString();
}

/// A number without a unit, as a certificate states it.
QString plain(double value, int digits) {
    return std::isfinite(value) ? QString::number(value, 'g', digits).replace('-', QChar(0x2212)) : QString("–");
}

/// A value whose uncertainty may be larger than itself keeps its decimals from the uncertainty.
QString plusMinus(double value, double expanded, const QString& unit) {
    return std::isfinite(value) && std::isfinite(expanded) ? quantityText(value, expanded, unit)
                                                           : quantityText(value, unit);
}

/// Alike in prefix and decimals, so that they compare by eye.
void putColumn(QTableWidget& table, int column, const std::vector<double>& values, const QString& unit) {
    const auto format = columnFormat(values, unit);
    for (int row = 0; row < int(values.size()); ++row) {
        const double value = values[std::size_t(row)];
        putText(table, row, column,
                format && std::isfinite(value) ? quantityText(value, unit, *format) : quantityText(value, unit), true);
    }
}

QString verdictText(const QString& key) {
    const QString shape = key == "pass" ? "✔" : key == "fail" ? "✖" : "?";
    return shape + " " + key;
}

}  // namespace

bool CalibrationResult::isCalibration(const json& value) {
    return value.is_object() && value.contains("levels") && value["levels"].is_array() && value.contains("budget") &&
           value["budget"].is_object() && value["budget"].contains("rows") && value.contains("gain");
}

CalibrationResult::CalibrationResult(const std::string& quantity, const json& found, QWidget* parent)
    : QWidget(parent), title_(quantityTitle(quantity)), unit_(words(found, "unit")) {
    setObjectName("calibrationResult-" + QString::fromStdString(quantity));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, fontMetrics().height() / 2);
    auto* head = new QLabel(tr("%1: %2").arg(title_, verdictText(words(found, "verdict"))), this);
    head->setObjectName("calibrationVerdict");
    auto font = head->font();
    font.setBold(true);
    font.setPointSizeF(font.pointSizeF() * 1.15);
    head->setFont(font);
    column->addWidget(head);
    addSummary(found);
    addLevels(found["levels"]);
    addBudget(found["budget"]);
}

void CalibrationResult::addSummary(const json& found) {
    auto* form = new QFormLayout;
    const auto add = [&](const QString& name, const QString& value, const QString& tip) {
        auto* shown = new QLabel(value, this);
        shown->setTextInteractionFlags(Qt::TextSelectableByMouse);
        shown->setWordWrap(true);
        shown->setToolTip(tip);
        form->addRow(name, shown);
    };
    add(tr("Gain"), plusMinus(numberIn(found, "gain"), numberIn(found, "gain_expanded_uncertainty"), {}),
        tr("Delivered over commanded, of the fitted line, with its uncertainty (95 %)."));
    add(tr("Offset"), plusMinus(numberIn(found, "offset"), numberIn(found, "offset_expanded_uncertainty"), unit_),
        tr("What the fitted line delivers for a command of 0, with its uncertainty (95 %)."));
    add(tr("U at the largest command"), quantityText(numberIn(found, "expanded_uncertainty"), unit_, 2),
        tr("Expanded uncertainty (95 %): the budget below says what it is made of."));
    add(tr("Largest residual"), quantityText(numberIn(found, "residual_max_pct_fs"), "% FS", 2),
        tr("The largest distance of a level's mean from the line, in % of the largest command."));
    add(tr("Repeatability"), quantityText(numberIn(found, "repeatability_pct_fs"), "% FS", 2),
        tr("Standard deviation of repeats in the same direction, in % of the largest command."));
    add(tr("Hysteresis"), quantityText(numberIn(found, "hysteresis_pct_fs"), "% FS", 2),
        tr("The largest difference between going up and down at one level, in % of the largest command."));
    auto readings = tr("n = %1").arg(countIn(found, "n"));
    const double outliers = numberIn(found, "outliers"), missing = numberIn(found, "not_measured");
    if (outliers > 0) readings += tr(", marked as standing out and kept: %1").arg(outliers);
    if (missing > 0) readings += tr(", not measured: %1").arg(missing);
    add(tr("Readings"), readings, tr("A reading that stands out is marked and stays in every number."));
    static_cast<QVBoxLayout*>(layout())->addLayout(form);
}

QTableWidget* CalibrationResult::addTable(const QString& name, const QStringList& columns, int rows) {
    auto* above = new QLabel(name, this);
    auto font = above->font();
    font.setBold(true);
    above->setFont(font);
    layout()->addWidget(above);
    auto* table = new QTableWidget(rows, int(columns.size()), this);
    table->setAccessibleName(tr("%1: %2").arg(title_, name));
    table->setHorizontalHeaderLabels(columns);
    table->verticalHeader()->hide();
    table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table->setAlternatingRowColors(true);
    table->setWordWrap(false);
    table->setTabKeyNavigation(false);
    table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    table->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    layout()->addWidget(table);
    return table;
}

void CalibrationResult::addLevels(const json& levels) {
    auto* table = addTable(tr("Levels"),
                           {tr("Commanded"), tr("n"), tr("Mean"), tr("Mean up"), tr("Mean down"), tr("s"), tr("Error"),
                            tr("U (95 %)"), tr("Tolerance ±"), tr("Verdict")},
                           int(levels.size()));
    table->setObjectName("calibrationLevels");
    table->setToolTip(
        tr("The error that is judged is that of the worse direction; a level passes when it is inside the tolerance "
           "by more than U."));
    const auto column = [&](const char* key) {
        std::vector<double> values;
        for (const auto& level : levels) values.push_back(numberIn(level, key));
        return values;
    };
    const char* keys[] = {"commanded", "", "mean", "mean_up", "mean_down", "s", "error", "expanded_uncertainty",
                          "tolerance"};
    for (int c = 0; c < int(std::size(keys)); ++c) {
        if (*keys[c] != '\0') putColumn(*table, c, column(keys[c]), unit_);
    }
    for (int row = 0; row < table->rowCount(); ++row) {
        const auto& level = levels[std::size_t(row)];
        putText(*table, row, 1, countIn(level, "n"), true);
        putText(*table, row, table->columnCount() - 1, verdictText(words(level, "verdict")), false);
    }
    fitToRows(*table);
}

void CalibrationResult::addBudget(const json& budget) {
    const auto& rows = budget["rows"];
    auto* table = addTable(tr("Uncertainty at the largest command"),
                           {tr("Contribution"), tr("Distribution"), tr("Value"), tr("Divisor"), tr("Sensitivity"),
                            tr("u (%1)").arg(axisUnit(0, unit_).unit), tr("Degrees of freedom")},
                           int(rows.size()) + 1);
    table->setObjectName("calibrationBudget");
    table->setToolTip(
        tr("Each contribution is its value over the divisor of its distribution, times its sensitivity. "
           "They are combined as the sum of squares (GUM)."));
    for (int row = 0; row < int(rows.size()); ++row) {
        const auto& one = rows[std::size_t(row)];
        const double freedom = numberIn(one, "degrees_of_freedom");
        putText(*table, row, 0, words(one, "name"), false);
        putText(*table, row, 1, words(one, "distribution"), false);
        putText(*table, row, 2, plain(numberIn(one, "value"), 3), true);
        putText(*table, row, 3, plain(numberIn(one, "divisor"), 4), true);
        putText(*table, row, 4, plain(numberIn(one, "sensitivity"), 4), true);
        putText(*table, row, 5, plain(numberIn(one, "contribution"), 3), true);
        putText(*table, row, 6, std::isfinite(freedom) ? plain(freedom, 3) : QString("∞"), true);
    }
    const int last = int(rows.size());
    const double factor = numberIn(budget, "coverage_factor");
    putText(*table, last, 0, tr("combined"), false);
    putText(*table, last, 1,
            tr("%1%2").arg(words(budget, "method"),
                           std::isfinite(factor) ? tr(", k = %1").arg(factor, 0, 'f', 2) : QString()),
            false);
    putText(*table, last, 5, plain(numberIn(budget, "combined"), 3), true);
    fitToRows(*table);
}

}  // namespace tacto::gui
