// CertificatePart.h - the texts of a stimulator calibration's certificate that only people know: a button with a form,
// and what is entered so far. The laboratory's own are kept; those of the item and its customer last until a
// calibration has used them, so that no later item gets them.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTemporaryDir>
#include <QWidget>
#include <filesystem>

#include "app/gui/theme/FieldForm.h"
#include "app/run/ProtocolRun.h"

namespace tacto::gui {

class CertificateForm final : public QDialog {
    Q_OBJECT
public:
    /// `order`: the file with the details of the item and its customer.
    CertificateForm(std::filesystem::path order, QWidget* parent);

private:
    void keep();

    const std::filesystem::path order_;
    FieldForm* form_;
    QLabel* says_;
};

class CertificatePart final : public QWidget {
    Q_OBJECT
public:
    explicit CertificatePart(QWidget* parent);
    /// Names the file with the details of the item, if there is one.
    void fill(RunOrder& order) const;
    /// Forgets the details of the item and its customer: its certificate has them.
    void forget();

private:
    [[nodiscard]] std::filesystem::path file() const;
    void show();

    const QTemporaryDir folder_;
    QLabel* says_;
};

}  // namespace tacto::gui
