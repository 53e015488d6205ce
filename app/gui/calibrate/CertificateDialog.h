// CertificateDialog.h - the calibration certificates of the lab's oscilloscopes: which one is in use, which expired,
// and a form to enter another.
//
// Entries are checked while they are typed, by the store's own rules, and can be withdrawn but not changed. An open
// bench keeps the values with which it was opened.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>

#include "app/gui/controller/BenchController.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/FieldForm.h"
#include "core/calibration/CertificateStore.h"

namespace tacto::gui {

// Every certificate that was entered, the newest first, and how each stands today: a row each, and
// as many columns as there is room for.

/// "U gain (%)", as the form names it too.
[[nodiscard]] QString figureTitle(const CertificateFigure& figure);

class CertificateTable final : public QTableWidget {
public:
    explicit CertificateTable(QWidget* parent);
    void show(const CertificateStore& store, CalibrationDate today);
    /// Hides columns until the others have room; a row's tool tip tells all of them.
    void fitColumns();
    /// Index into the store of the row that is chosen; -1: none, or it is withdrawn.
    [[nodiscard]] int chosen() const;
    /// Empty: none.
    [[nodiscard]] QString chosenNumber() const;
};

class CertificateDialog final : public QDialog {
    Q_OBJECT
public:
    /// Proposes the oscilloscope that is open on `controller`.
    explicit CertificateDialog(BenchController& controller, QWidget* parent);

protected:
    void changeEvent(QEvent* event) override;

private:
    void buildForm(QVBoxLayout& column);
    /// As it stands in the form.
    [[nodiscard]] std::string text(std::string_view field) const;
    /// As written in the form. Errors: InvalidArgument, one sentence.
    [[nodiscard]] Result<Certificate> written() const;
    void judge();
    void enter();
    void withdraw();
    void nameWithdraw();
    void list();

    FieldForm* names_ = nullptr;  // whose certificate, and its days
    FieldForm* figures_ = nullptr;
    QLabel* empty_;
    CertificateTable* table_ = nullptr;
    QLabel* says_;
    QPushButton* enter_ = nullptr;
    ConfirmButton* withdraw_ = nullptr;
    bool asksWithdraw_ = false;  // the button is at its second step
};

}  // namespace tacto::gui
