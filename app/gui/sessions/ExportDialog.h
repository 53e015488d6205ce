// ExportDialog.h - asks in which format and where a session is exported, says how large that becomes and what is left
// out and why, exports, and shows the result in its folder.
//
// Reading and writing run on another thread; closing the dialog cancels, and then nothing is left.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <filesystem>
#include <memory>

#include "app/gui/sessions/Background.h"
#include "app/gui/theme/FieldForm.h"
#include "core/exchange/Export.h"

namespace tacto::gui {

/// Exports on the thread of `port`, whose progress is in thousandths. Errors: as exportSession().
[[nodiscard]] Result<ExportReport> exportWith(const WorkPort& port, const std::filesystem::path& session,
                                              const ExportFormat& format, const std::filesystem::path& out);

class ExportDialog final : public QDialog {
    Q_OBJECT
public:
    ExportDialog(std::filesystem::path session, QWidget* parent);

private:
    void addFormats(bool ofCalibration);
    [[nodiscard]] QWidget* buildPlace();
    [[nodiscard]] QWidget* buildButtons();
    [[nodiscard]] const ExportFormat& format() const;
    void look();
    void showFormat();
    void askPlace();
    void begin();
    void ended(const Result<ExportReport>& done);

    const std::filesystem::path session_;
    std::shared_ptr<const ExportSource> source_;
    std::filesystem::path made_;  ///< by the last export that succeeded
    FieldForm* form_;
    QLineEdit* place_ = nullptr;
    QPushButton* choose_ = nullptr;
    QLabel* holds_;
    QLabel* says_;
    QProgressBar* progress_;
    QPushButton* export_ = nullptr;
    QPushButton* folder_ = nullptr;
    QPushButton* close_ = nullptr;
    Background work_;
};

}  // namespace tacto::gui
