// ProcedurePath.h - the column at the left of a procedure: what it is, its steps and how each stands, and what runs it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>

namespace tacto::gui {

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

    /// Another procedure was read: nothing of it has run.
    void showNoRun(bool hasReference);
    void showRun();
    /// The result can be gone to. `early`: the run was stopped or failed.
    void showEnd(bool early);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    ProtocolHead* head_;
    StepList* steps_;
    RunPanel* panel_;
};

}  // namespace tacto::gui
