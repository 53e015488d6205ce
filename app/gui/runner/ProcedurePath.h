// ProcedurePath.h - the column at the left of a procedure: what it is, its steps and how each stands, and what runs it.
// Where a column would take too much of the room (large text, a small window) it is a row on top.
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
    /// `chooses`: the procedure is chosen here; else it is a fixed one.
    ProcedurePath(bool chooses, QWidget* parent);
    [[nodiscard]] ProtocolHead& head() noexcept { return *head_; }
    [[nodiscard]] StepList& steps() noexcept { return *steps_; }
    [[nodiscard]] RunPanel& panel() noexcept { return *panel_; }

    /// A row where a column would take more than a third of `room`, its owner's width. Returns whether it is one.
    bool fit(int room);
    /// Another procedure was read, of which nothing has run.
    void showNoRun(bool hasReference);
    /// The steps before the run. A tick says that a step was seen, or that the run used it.
    void showSetup(FieldForm& form, const QString& devices, bool declared, bool begun, const std::set<Step>& seen);
    void showRun();
    /// The result can be gone to. `early`: the run was stopped or failed.
    void showEnd(bool early, std::optional<Seconds> benchTime);
    /// Shows how to read the limits and loads, where there is room below the steps.
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
