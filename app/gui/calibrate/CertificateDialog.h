// CertificateDialog.h - the calibration certificates of the lab's oscilloscopes: which is in use, which has expired,
// and a form for a new one.
//
// Entries are checked during typing by the store's own rules, and can be withdrawn but not changed. An open bench keeps
// the values with which it was opened.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <filesystem>
#include <map>

#include "app/gui/controller/BenchController.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/FieldForm.h"
#include "core/calibration/CertificateStore.h"
#include "core/exchange/dcc/DccCertificate.h"

namespace tacto::gui {

// Table of all certificates entered, newest first, with their state today: one row each, with as many columns as fit.

/// Returns, for example, "U gain (%)"; the form uses the same title.
[[nodiscard]] QString figureTitle(const CertificateFigure& figure);

class CertificateTable final : public QTableWidget {
public:
    explicit CertificateTable(QWidget* parent);
    void show(const CertificateStore& store, CalibrationDate today);
    /// Hides columns until the others fit; a row's tool tip shows all of them.
    void fitColumns();
    /// Returns the chosen row's index in the store; -1 if none is chosen or the certificate is withdrawn.
    [[nodiscard]] int chosen() const;
    /// Returns the number of the chosen certificate; empty if there is none.
    [[nodiscard]] QString chosenNumber() const;
};

class CertificateDialog final : public QDialog {
    Q_OBJECT
public:
    /// Proposes the oscilloscope open on `controller`.
    explicit CertificateDialog(BenchController& controller, QWidget* parent);

protected:
    void changeEvent(QEvent* event) override;

private:
    void buildForm(QVBoxLayout& column);
    /// Returns the text of a field in the form.
    [[nodiscard]] std::string text(std::string_view field) const;
    /// Returns the certificate entered in the form. Errors: InvalidArgument, one sentence.
    [[nodiscard]] Result<Certificate> written() const;
    void judge();
    /// Returns what the person wrote in a field; empty if the text came from a file and is unchanged.
    [[nodiscard]] std::string typed(const std::string& field) const;
    /// Fills the form from a digital certificate; what it does not state is taken from what was typed into the form.
    /// One of a shunt or a probe is added to the oscilloscope's.
    void readFile(const std::filesystem::path& path);
    void enter();
    void withdraw();
    void nameWithdraw();
    void list();

    FieldForm* names_ = nullptr;  // instrument and dates of the certificate
    FieldForm* figures_ = nullptr;
    QLabel* empty_;
    CertificateTable* table_ = nullptr;
    QLabel* says_;
    QPushButton* enter_ = nullptr;
    ConfirmButton* withdraw_ = nullptr;
    std::vector<DccFile> files_;                    // read since the last was entered; the oscilloscope's first
    std::map<std::string, std::string> fromFiles_;  // what they wrote into the fields
    bool asksWithdraw_ = false;                     // the Withdraw button waits for its second click
};

}  // namespace tacto::gui
