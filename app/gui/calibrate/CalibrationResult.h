// CalibrationResult.h - what a calibration of one quantity came to: the line and how far the device keeps to it, each
// level with its uncertainty and verdict, and the uncertainty budget contribution by contribution.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>
#include <nlohmann/json.hpp>

#include "app/gui/theme/RecordColumns.h"

namespace tacto::gui {

class CalibrationResult final : public QWidget {
    Q_OBJECT
public:
    /// `found` as the protocol's result has it: isCalibration(found).
    CalibrationResult(const std::string& quantity, const nlohmann::json& found, QWidget* parent = nullptr);
    [[nodiscard]] static bool isCalibration(const nlohmann::json& value);

private:
    void addSummary(const nlohmann::json& found);
    void addLevels(const nlohmann::json& levels);
    void addBudget(const nlohmann::json& budget);
    void addTable(const QString& name, const char* objectName, const QString& tip,
                  const std::vector<ResultColumn>& columns, const nlohmann::json& rows);
    QString title_;
    QString unit_;
};

}  // namespace tacto::gui
