// LoadRows.h - the loads of a safety check as rows that turn to verdicts while they are measured.
#pragma once

#include <QTableWidget>
#include <nlohmann/json.hpp>

namespace tacto::gui {

class LoadRows final : public QTableWidget {
    Q_OBJECT
public:
    explicit LoadRows(QWidget* parent = nullptr);
    /// The bench set, all of it still to be done.
    void begin();
    /// A command that was measured (type "command") or what a load has come to (type "load", with its verdict); any
    /// other trial is passed over.
    void add(const nlohmann::json& trial);
    /// Takes the run's results, whose verdicts are the last word; null for none. Loads that were not reached say so.
    void end(const nlohmann::json& results);
    /// "✔ pass", as it stands there; empty for a load ("500 ohm") that is not listed.
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
