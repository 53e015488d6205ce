// ProcedurePages.h - one page for each step of a procedure: wiring, known reference, settings, run and result, report.
#pragma once

#include <QBoxLayout>

#include "app/gui/theme/Pages.h"
#include "app/scripting/engine/ProtocolDeclaration.h"

namespace tacto::gui {

class CertificatePart;
class DayNotes;
class NotesPanel;
class FieldForm;
class RunViews;
class SignPage;
class WiringPage;
class WiringPanel;
class WorstPage;

/// The steps in order. Run and Result share one page, without and with the verdict.
enum Step { kWiring, kReference, kSettings, kRun, kResult, kSign };

class ProcedurePages final : public PageStack {
    Q_OBJECT
public:
    explicit ProcedurePages(DayNotes& day, QWidget* parent = nullptr);
    /// Shows the fields and pages of this protocol.
    void offer(const ProtocolDeclaration& declaration);
    void showStep(Step step);
    /// Sets whether the settings can be changed; while a protocol runs they cannot.
    void setChangeable(bool changeable);

    [[nodiscard]] WiringPanel& wiring() noexcept { return *wiring_; }
    [[nodiscard]] FieldForm& form() noexcept { return *form_; }
    [[nodiscard]] WorstPage& worst() noexcept { return *worst_; }
    [[nodiscard]] RunViews& views() noexcept { return *views_; }
    [[nodiscard]] CertificatePart& certificate() noexcept { return *certificate_; }
    [[nodiscard]] SignPage& sign() noexcept { return *sign_; }

private:
    [[nodiscard]] QWidget* buildWiring();
    [[nodiscard]] QWidget* buildReference();
    [[nodiscard]] QWidget* buildSettings(DayNotes& day);
    [[nodiscard]] QBoxLayout* turning();
    WiringPanel* wiring_ = nullptr;
    WiringPage* drawing_ = nullptr;
    FieldForm* form_ = nullptr;
    NotesPanel* notes_ = nullptr;
    CertificatePart* certificate_ = nullptr;  ///< shown for the calibration of a stimulator
    WorstPage* worst_ = nullptr;
    RunViews* views_ = nullptr;
    SignPage* sign_ = nullptr;
};

}  // namespace tacto::gui
