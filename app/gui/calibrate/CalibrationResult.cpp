#include "app/gui/calibrate/CalibrationResult.h"

#include <QFormLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/calibrate/CalibrationReadings.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/Verdict.h"
#include "app/report/NumberText.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

using nlohmann::json;

QString countIn(const json& in, const char* key) { return decimalText(numberOr(in, key), 0); }

QString words(const json& in, const char* key) { return QString::fromStdString(textOr(in, key)); }

/// A value whose uncertainty may be larger than itself keeps its decimals from the uncertainty.
QString plusMinus(double value, double expanded, const QString& unit) {
    return std::isfinite(value) && std::isfinite(expanded) ? quantityText(value, expanded, unit)
                                                           : quantityText(value, unit);
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
    column->setContentsMargins(0, 0, 0, 8);
    auto* head = new QLabel(tr("%1: %2").arg(title_, verdictText(words(found, "verdict"))), this);
    head->setObjectName("calibrationVerdict");
    setTextSize(*head, TextSize::Large);
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
    add(tr("Gain"), plusMinus(numberOr(found, "gain"), numberOr(found, "gain_expanded_uncertainty"), {}),
        tr("Delivered over commanded, of the fitted line, with its uncertainty (95 %)."));
    add(tr("Offset"), plusMinus(numberOr(found, "offset"), numberOr(found, "offset_expanded_uncertainty"), unit_),
        tr("What the fitted line delivers for a command of 0, with its uncertainty (95 %)."));
    add(tr("U at the largest command"), quantityText(numberOr(found, "expanded_uncertainty"), unit_, 2),
        tr("Expanded uncertainty (95 %): the budget below says what it is made of."));
    add(tr("Largest residual"), quantityText(numberOr(found, "residual_max_pct_fs"), "% FS", 2),
        tr("The largest distance of a level's mean from the line, in % of the largest command."));
    add(tr("Repeatability"), quantityText(numberOr(found, "repeatability_pct_fs"), "% FS", 2),
        tr("Standard deviation of repeats in the same direction, in % of the largest command."));
    add(tr("Hysteresis"), quantityText(numberOr(found, "hysteresis_pct_fs"), "% FS", 2),
        tr("The largest difference between going up and down at one level, in % of the largest command."));
    auto readings = tr("n = %1").arg(countIn(found, "n"));
    const double outliers = numberOr(found, "outliers"), missing = numberOr(found, "not_measured");
    if (outliers > 0) readings += tr(", marked as standing out and kept: %1").arg(outliers);
    if (missing > 0) readings += tr(", not measured: %1").arg(missing);
    add(tr("Readings"), readings, tr("An outlier is marked and stays in every number."));
    static_cast<QVBoxLayout*>(layout())->addLayout(form);
}

void CalibrationResult::addTable(const QString& name, const char* objectName, const QString& tip,
                                 const std::vector<ResultColumn>& columns, const json& rows) {
    auto* above = new QLabel(name, this);
    setTextSize(*above, TextSize::Body, true);
    layout()->addWidget(above);
    auto* table = makeRecordTable(columns, rows, this);
    table->setObjectName(objectName);
    table->setAccessibleName(tr("%1: %2").arg(title_, name));
    table->setToolTip(tip);
    layout()->addWidget(table);
}

void CalibrationResult::addLevels(const json& levels) {
    using As = ResultColumn::As;
    const auto unit = unit_.toStdString();
    auto rows = levels;
    for (auto& row : rows) {
        // A session of an earlier version has the mean's error alone.
        const bool worst = row.contains("worst_error");
        const char* error = worst ? "worst_error" : "error";
        const char* expanded = worst ? "worst_expanded_uncertainty" : "expanded_uncertainty";
        row["judged_error"] = row.value(error, json());
        row["judged_u"] = row.value(expanded, json());
        const double used =
            (std::abs(numberOr(row, "judged_error")) + numberOr(row, "judged_u")) / numberOr(row, "tolerance");
        row["used"] = std::isfinite(used) ? json(used) : json();
    }
    addTable(tr("Levels"), "calibrationLevels",
             tr("The error that is judged is that of the worse direction; a level passes when it is inside the "
                "tolerance by more than U."),
             {{"Verdict", "verdict", As::Verdict},
              {"Commanded", "commanded", As::Number, unit},
              {"n", "n", As::Number},
              {"Mean, going up", "mean_up", As::Number, unit},
              {"Mean, going down", "mean_down", As::Number, unit},
              {"s", "s", As::Spread, unit},
              {"Error ± U", "judged_error", As::Number, unit, "judged_u"},
              {"Tolerance, ±", "tolerance", As::Number, unit},
              {"Tolerance used", "used", As::Used}},
             rows);
}

void CalibrationResult::addBudget(const json& budget) {
    using As = ResultColumn::As;
    const auto unit = unit_.toStdString();
    auto rows = budget["rows"];
    for (auto& row : rows) {
        if (row.contains("degrees_of_freedom") && !row["degrees_of_freedom"].is_number())
            row["degrees_of_freedom"] = "∞";
    }
    const double factor = numberOr(budget, "coverage_factor");
    const auto method = words(budget, "method");
    rows.push_back(
        {{"name", tr("combined").toStdString()},
         {"distribution",
          (std::isfinite(factor) ? tr("%1, k = %2").arg(method, decimalText(factor, 2)) : method).toStdString()},
         {"contribution", budget.value("combined", json())}});
    addTable(tr("Uncertainty at the largest command"), "calibrationBudget",
             tr("Each contribution is its value over the divisor of its distribution, times its sensitivity. "
                "They are combined as the sum of squares (GUM)."),
             {{"Contribution", "name"},
              {"Distribution", "distribution"},
              {"Value", "value", As::Number},
              {"Divisor", "divisor", As::Number},
              {"Sensitivity", "sensitivity", As::Number},
              {"u", "contribution", As::Number, unit},
              {"Degrees of freedom", "degrees_of_freedom"}},
             rows);
}

}  // namespace tacto::gui

#include "moc_CalibrationResult.cpp"
