// LoadRows.h - table of a safety check's loads; each row shows its verdict once measured.
#pragma once

#include <QTableWidget>
#include <nlohmann/json.hpp>

namespace tacto::gui {

class LoadRows final : public QTableWidget {
    Q_OBJECT
public:
    explicit LoadRows(QWidget* parent = nullptr);
    /// Lists the loads of the bench set, all still to be measured.
    void begin();
    /// Adds a measured command (type "command") or the verdict of a load (type "load"); ignores any other trial.
    void add(const nlohmann::json& trial);
    /// Shows the final verdicts from the run's results; null for no results. Loads that were not reached say so.
    void end(const nlohmann::json& results);
    /// Returns the verdict as shown, such as "✔ pass"; empty for a load ("500 ohm") that is not listed.
    [[nodiscard]] QString verdictOf(const QString& load) const;

private:
    enum Column { kLoad, kVerdict, kMeasured, kCommands, kPeak, kRms, kColumns };
    [[nodiscard]] int rowOf(const QString& load);
    void write(int row, Column column, const QString& text);
    void numbers(int row, const nlohmann::json& values, const char* measured);
    void judge(int row, const QString& verdict);
    void fit();
    void colour();
};

}  // namespace tacto::gui
