// ProcedurePath.h - the column at the left of a procedure: its title, its steps with their states, and the controls to
// run it. If a column would take too much space (large text, a small window), this is a row at the top.
#pragma once

#include <QWidget>
#include <set>

#include "app/gui/runner/ProcedurePages.h"

namespace tacto::gui {

class CellLegend;
class FieldForm;
class ProtocolHead;
class RunPanel;
class StepList;

class ProcedurePath final : public QWidget {
    Q_OBJECT
public:
    /// `chooses`: the operator chooses the procedure here; otherwise it is fixed.
    ProcedurePath(bool chooses, QWidget* parent);
    [[nodiscard]] ProtocolHead& head() noexcept { return *head_; }
    [[nodiscard]] StepList& steps() noexcept { return *steps_; }
    [[nodiscard]] RunPanel& panel() noexcept { return *panel_; }

    /// Becomes a row if a column would take over a third of the width of `room`, or would put Run below its height.
    /// Returns true for a row.
    bool fit(QSize room);
    /// Resets the path for a newly read procedure that has not run.
    void showNoRun(bool hasReference);
    /// Shows the steps before the run. A tick means that a step was seen, or that the run used its settings.
    void showSetup(FieldForm& form, const WiringPanel& wiring, bool declared, bool begun, const std::set<Step>& seen);
    void showRun();
    /// Makes the result reachable. `early`: the run was stopped or failed.
    void showEnd(bool early, std::optional<Seconds> benchTime);
    /// Shows how to read the limits and loads, if there is room below the steps.
    void showLegend(bool legend);

protected:
    bool event(QEvent* event) override;

private:
    void layDown();
    void layAcross();
    void fitLegend();
    ProtocolHead* head_;
    StepList* steps_;
    CellLegend* legend_;
    RunPanel* panel_;
    bool across_ = false;
    bool legendWanted_ = false;
};

}  // namespace tacto::gui
