#include "app/gui/calibrate/CertificatePart.h"

#include <QDialogButtonBox>
#include <algorithm>
#include <array>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/calibration/CertificateDetails.h"

namespace tacto::gui {

namespace {

constexpr int kDetailChars = 72;  // width in characters

/// What an empty field waits for, by the detail's key.
QString hintOf(std::string_view key) {
    constexpr std::array<std::pair<std::string_view, const char*>, 14> kHints{
        {{"laboratory", QT_TR_NOOP("name of your laboratory")},
         {"address", QT_TR_NOOP("street and town of the laboratory")},
         {"place", QT_TR_NOOP("where the run takes place, such as room 12")},
         {"number", QT_TR_NOOP("your number of this certificate, such as LT-26-017")},
         {"customer", QT_TR_NOOP("who ordered the calibration")},
         {"contact", QT_TR_NOOP("who speaks for the customer")},
         {"make", QT_TR_NOOP("who made the stimulator")},
         {"model", QT_TR_NOOP("as the stimulator reports it")},
         {"serial", QT_TR_NOOP("as the stimulator reports it")},
         {"condition", QT_TR_NOOP("such as: no damage seen")},
         {"received", QT_TR_NOOP("as 2026-11-21")},
         {"issued", QT_TR_NOOP("as 2026-11-21")},
         {"authorised_by", QT_TR_NOOP("who signs for the laboratory")},
         {"function", QT_TR_NOOP("of who signs, such as head of laboratory")}}};
    const auto found = std::ranges::find(kHints, key, &std::pair<std::string_view, const char*>::first);
    return found == kHints.end() ? QString() : CertificateForm::tr(found->second);
}

std::filesystem::path ifThere(const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored) ? file : std::filesystem::path();
}

}  // namespace

CertificateForm::CertificateForm(std::filesystem::path order, QWidget* parent)
    : QDialog(parent), order_(std::move(order)) {
    setObjectName("certificateForm");
    setWindowTitle(tr("Certificate"));
    auto* page = new ScrollingPage(this);
    auto* all = new QWidget(page->viewport());
    auto* column = columnIn(*all);
    column->addWidget(heading(tr("What only people know of the certificate"), this));
    column->addWidget(explanation(tr("An entry that is missing becomes a ruled line to write on. Laboratory, address, "
                                     "place and who authorises are kept for all certificates; the others for the next "
                                     "calibration alone."),
                                  this));
    const auto known = certificateDetails(ifThere(order_), utcToday());
    const auto details = known.value_or(CertificateDetails());
    std::vector<FormField> fields;
    for (const auto& detail : kCertificateDetails) {
        const auto title = qtext(detail.title), text = qtext(details.*detail.member);
        if (detail.isDate)
            fields.push_back(dayField(detail.key.data(), title, tr("For example 2026-11-21."), hintOf(detail.key)));
        else
            fields.push_back(
                textField(detail.key.data(), title, text, tr("As it stands on the certificate."), hintOf(detail.key)));
    }
    form_ = new FieldForm(all, FieldForm::Labels::Beside);
    form_->show(fields);
    for (const auto& detail : kCertificateDetails)
        if (detail.isDate) form_->set(std::string(detail.key), qtext(details.*detail.member));
    column->addWidget(form_);
    column->addStretch(1);
    page->hold(all);
    auto* frame = new QVBoxLayout(this);
    frame->addWidget(page, 1);
    says_ = makeLabel(known ? QString() : sentence(known.error()),
                      {.name = "certificateFormSays", .tone = Tone::Warning, .wraps = true, .selectable = true}, this);
    frame->addWidget(says_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    auto* keeps = buttons->addButton(tr("&Keep"), QDialogButtonBox::ActionRole);
    makePrimary(*keeps);
    frame->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(keeps, &QPushButton::clicked, this, &CertificateForm::keep);
    const auto fit = [this, all, frame] {
        resize(fontMetrics().averageCharWidth() * kDetailChars, all->sizeHint().height() + frame->sizeHint().height());
    };
    fit();
    onFontChange(*this, fit);
}

void CertificateForm::keep() {
    CertificateDetails details;
    for (const auto& detail : kCertificateDetails)
        details.*detail.member = form_->text(std::string(detail.key)).simplified().toStdString();
    if (const auto kept = keepCertificateDetails(details, order_, utcToday()); !kept)
        return says_->setText(sentence(kept.error()));
    accept();
}

CertificatePart::CertificatePart(QWidget* parent) : QWidget(parent) {
    auto* column = columnIn(*this);
    auto* asks = pageButton(tr("&Certificate…"), "certificateDetails",
                            tr("Laboratory, customer, item and who authorises: what the certificate states and the "
                               "program cannot know."),
                            this);
    says_ = makeLabel({}, {.name = "certificateGiven", .tone = Tone::Quiet, .wraps = true, .plain = true}, this);
    column->addWidget(says_);
    column->addWidget(asks, 0, Qt::AlignLeft);
    connect(asks, &QPushButton::clicked, this, [this] {
        auto* form = new CertificateForm(file(), this);
        connect(form, &QDialog::accepted, this, &CertificatePart::show);
        openDialog(form);
    });
    onEvent(*this, QEvent::Show, [this] { show(); });
}

std::filesystem::path CertificatePart::file() const { return folder_.filePath("order.json").toStdString(); }

void CertificatePart::fill(RunOrder& order) const { order.certificateDetails = ifThere(file()); }

void CertificatePart::forget() {
    std::error_code ignored;
    std::filesystem::remove(file(), ignored);
    show();
}

void CertificatePart::show() {
    const auto known = certificateDetails(ifThere(file()), utcToday());
    if (!known) return says_->setText(sentence(known.error()));
    QStringList given;
    for (const auto& text : {known->laboratory, known->customer, known->make, known->model, known->serial})
        if (!text.empty()) given << qtext(text);
    says_->setText(given.isEmpty() ? tr("The certificate has lines to write laboratory and customer on.")
                                   : tr("The certificate says: %1.").arg(given.join(", ")));
}

}  // namespace tacto::gui

#include "moc_CertificatePart.cpp"
