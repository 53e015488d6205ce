#include "app/gui/calibrate/CertificateDialog.h"

#include <QDialogButtonBox>
#include <QEvent>
#include <QHeaderView>
#include <array>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/TypedNumber.h"
namespace tacto::gui {

namespace {

constexpr int kWide = 1020;  // width in pixels for all columns

}  // namespace

CertificateDialog::CertificateDialog(BenchController& controller, QWidget* parent) : QDialog(parent) {
    setObjectName("certificateDialog");
    setWindowTitle(tr("Oscilloscope certificates"));
    auto* page = new ScrollingPage(this);
    auto* all = new QWidget(page->viewport());
    auto* column = columnIn(*all);
    column->addWidget(heading(tr("Calibration certificates of oscilloscopes"), this));
    column->addWidget(
        explanation(tr("The expanded uncertainties U (k = 2) of a certificate are used for captures of the "
                       "oscilloscope with its serial number, from its date until it is due, in place of "
                       "the data sheet's. A bench that is open keeps what it was opened with."),
                    this));
    empty_ = makeLabel(tr("No certificate is entered."), {.tone = Tone::Quiet}, this);
    column->addWidget(empty_);
    table_ = new CertificateTable(this);
    column->addWidget(table_);
    withdraw_ = new ConfirmButton({}, this);
    withdraw_->setObjectName("withdrawCertificate");
    withdraw_->setAutoDefault(false);
    withdraw_->setToolTip(
        tr("Withdraws a certificate that was entered wrongly. It stays in the list but is no longer used."));
    auto* row = new QHBoxLayout;
    row->addStretch(1);
    row->addWidget(withdraw_);
    column->addLayout(row);
    buildForm(*column);
    column->addStretch(1);
    page->hold(all);
    auto* frame = new QVBoxLayout(this);
    frame->addWidget(page, 1);
    says_ = makeLabel({}, {.name = "certificateSays", .wraps = true, .selectable = true}, this);
    frame->addWidget(says_);  // always visible, like the button to which it refers
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    enter_ = buttons->addButton(tr("&Enter certificate"), QDialogButtonBox::ActionRole);
    enter_->setObjectName("enterCertificate");
    enter_->setToolTip(tr("Saves the certificate. It is used when a bench is opened with this oscilloscope."));
    auto* read = buttons->addButton(tr("&Read file…"), QDialogButtonBox::ActionRole);
    read->setObjectName("readCertificate");
    read->setAutoDefault(false);
    read->setToolTip(tr("Fills the form from a digital calibration certificate (DCC, an XML file)."));
    connect(read, &QPushButton::clicked, this, [this] {
        askForFile(*this, {.title = tr("Read a digital certificate"), .filters = {tr("Digital certificates (*.xml)")}},
                   [this](const QString& path) { readFile(path.toStdString()); });
    });
    frame->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(enter_, &QPushButton::clicked, this, &CertificateDialog::enter);
    connect(withdraw_, &QPushButton::clicked, this, &CertificateDialog::withdraw);
    connect(table_, &QTableWidget::itemSelectionChanged, this, [this] {
        asksWithdraw_ = false;
        nameWithdraw();
    });
    if (const auto open = controller.open()) {
        for (const auto& device : open->about.devices) {
            if (device.role != nameOf(Role::Oscilloscope)) continue;
            names_->set("instrument", qtext(device.name));
            names_->set("serial", qtext(device.serial));
        }
    }
    list();
    judge();
    // High enough for the whole page, if the screen allows; otherwise the page scrolls.
    resize(scaledPx(kWide), sizeHint().height() - page->sizeHint().height() + wholeHeightAt(*column, scaledPx(kWide)));
    onEvent(*this, QEvent::Resize, [this] { table_->fitColumns(); });
}

void CertificateDialog::changeEvent(QEvent* event) {
    QDialog::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && enter_ != nullptr) list();  // applies the new theme's grey
}

void CertificateDialog::buildForm(QVBoxLayout& column) {
    const std::array tips{tr("Maker and model."), tr("As the instrument reports it. It tells two of a model apart."),
                          tr("As on the certificate."), tr("Who issued it.")};
    std::vector<FormField> names, figures;
    for (std::size_t i = 0; i < tips.size(); ++i) {
        const auto& text = kCertificateTexts[i];
        names.push_back(textField(text.key.data(), titled(qtext(text.title)), {}, tips[i]));
    }
    names.push_back(dayField("date", tr("Date"), tr("Calibration date, for example 2026-11-21."), tr("2026-11-21")));
    names.push_back(
        dayField("due", tr("Due"), tr("The last day on which it is used, for example 2027-11-20."), tr("2026-11-21")));
    for (const auto& figure : kCertificateFigures)
        figures.push_back(
            textField(figure.option, figureTitle(figure), {},
                      tr("Expanded uncertainty with k = 2, above 0 to %1 %2.").arg(figure.most).arg(qtext(figure.unit)),
                      figure.required ? QString() : tr("not stated")));
    auto* row = new QHBoxLayout;
    row->setSpacing(16);
    const auto add = [&](const std::vector<FormField>& fields) {
        auto* form = new FieldForm(this, FieldForm::Labels::Beside);
        form->show(fields);
        connect(form, &FieldForm::edited, this, &CertificateDialog::judge);
        row->addWidget(form, 1, Qt::AlignTop);
        return form;
    };
    names_ = add(names);
    figures_ = add(figures);
    column.addLayout(row);
}

std::string CertificateDialog::text(std::string_view field) const {
    const std::string name(field);
    return (names_->text(name) + figures_->text(name)).toStdString();  // the field is in one of the two forms
}

Result<Certificate> CertificateDialog::written() const {
    Certificate out;
    for (const auto& [key, title, member] : kCertificateTexts) {
        out.*member = text(key);
        if ((out.*member).empty()) return fail(ErrorCode::InvalidArgument, "the {} is missing", title);
    }
    for (const auto& [field, title, day] :
         {std::tuple{"date", "date", &Certificate::date}, std::tuple{"due", "due date", &Certificate::due}}) {
        const auto date = parseDate(text(field));
        if (!date)
            return fail(ErrorCode::InvalidArgument, "the {} is \"{}\"; a day as 2026-11-21 is expected", title,
                        text(field));
        out.*day = *date;
    }
    for (const auto& figure : kCertificateFigures) {
        const auto written = text(figure.option);
        if (written.empty()) continue;
        const auto u = typedNumber(written);
        if (!u) {
            return fail(ErrorCode::InvalidArgument, "U of the {} is \"{}\"; above 0 to {} {} is accepted{}",
                        figure.title, written, figure.most, figure.unit, typedTrouble(written));
        }
        out.*figure.member = *u;
    }
    if (auto sound = check(out); !sound) return failure(sound);
    return out;
}

void CertificateDialog::judge() {
    if (enter_ == nullptr) return;
    const auto certificate = written();
    enter_->setEnabled(certificate.has_value());
    if (!certificate) return says_->setText(sentence(certificate.error()));
    const auto today = utcToday();
    says_->setText(certificate->due < today    ? tr("It has expired: it would be kept but not used.")
                   : certificate->date > today ? tr("It is dated in the future: it is not used before its date.")
                                               : QString());
}

std::string CertificateDialog::typed(const std::string& field) const {
    const auto written = text(field);
    const auto read = fromFiles_.find(field);
    return read != fromFiles_.end() && read->second == written ? std::string() : written;
}

void CertificateDialog::readFile(const std::filesystem::path& path) {
    auto file = readDcc(path);
    if (!file) return says_->setText(sentence(file.error()));
    // One that states a gain is of an oscilloscope, and begins anew; others are added.
    auto files = statesGain(*file) ? std::vector<DccFile>() : files_;
    std::erase_if(
        files, [&](const DccFile& each) { return each.number == file->number && each.laboratory == file->laboratory; });
    files.push_back(std::move(*file));
    Certificate given;
    if (const auto due = parseDate(typed("due"))) given.due = *due;
    const auto& items = files.front().items;
    if (items.size() > 1) given.serial = text("serial");
    if (items.size() == 1 && items.front().serial.empty()) given.serial = typed("serial");
    for (const auto& figure : kCertificateFigures) given.*figure.member = typedNumber(typed(figure.option));
    const auto read = certificateFrom(files, given);
    if (!read) return says_->setText(sentence(read.error()));
    files_ = std::move(files);
    fromFiles_.clear();
    const auto& certificate = read->certificate;
    const auto fill = [this](FieldForm& form, const std::string& field, const std::string& value, bool wasGiven) {
        form.set(field, qtext(value));
        if (!wasGiven) fromFiles_[field] = value;
    };
    for (const auto& [key, title, member] : kCertificateTexts)
        fill(*names_, std::string(key), certificate.*member, certificate.*member == given.*member);
    fill(*names_, "date", dateText(certificate.date), false);
    fill(*names_, "due", dateText(certificate.due), certificate.due == given.due);
    for (const auto& figure : kCertificateFigures) {
        const auto& known = certificate.*figure.member;
        fill(*figures_, figure.option, known ? fmt::format("{}", *known) : std::string(),
             (given.*figure.member).has_value());
    }
    judge();
    QStringList says{says_->text()};
    for (const auto& note : read->notes) says << sentence(qtext(note));
    says.removeAll(QString());
    says_->setText(says.join(' '));
}

void CertificateDialog::enter() {
    const auto certificate = written();
    if (!certificate) return;
    auto store = CertificateStore::open(certificateFile());
    if (!store) return says_->setText(sentence(store.error()));
    if (const auto added = store->add(*certificate, utcToday()); !added) return says_->setText(sentence(added.error()));
    list();
    files_.clear();
    names_->set("number", {});  // the next certificate has another number
    says_->setText(tr("Certificate %1 is entered.").arg(qtext(certificate->number)));
}

void CertificateDialog::nameWithdraw() {
    const int index = table_->chosen();
    withdraw_->setEnabled(index >= 0);
    if (index < 0) asksWithdraw_ = false;
    withdraw_->setMeaning(asksWithdraw_ ? tr("Withdraw %1 for good").arg(table_->chosenNumber()) : tr("&Withdraw…"),
                          asksWithdraw_);
}

void CertificateDialog::withdraw() {
    const int index = table_->chosen();
    if (index < 0 || !withdraw_->listens()) return;
    if (!asksWithdraw_) {
        asksWithdraw_ = true;
        return nameWithdraw();
    }
    asksWithdraw_ = false;
    auto store = CertificateStore::open(certificateFile());
    if (!store) return says_->setText(sentence(store.error()));
    const auto certificate = store->all().at(std::size_t(index)).certificate;  // valid, since entries are never removed
    if (const auto done = store->withdraw(certificate.number, certificate.serial, utcToday()); !done)
        return says_->setText(sentence(done.error()));
    list();
    says_->setText(tr("Certificate %1 is withdrawn.").arg(qtext(certificate.number)));
}

void CertificateDialog::list() {
    table_->setRowCount(0);
    const auto store = CertificateStore::open(certificateFile());
    const bool any = store && !store->all().empty();
    empty_->setVisible(!any);
    table_->setVisible(any);
    withdraw_->setVisible(any);
    if (!store) {
        empty_->setText(tr("%1 No certificate is used.").arg(sentence(store.error())));
        return;
    }
    table_->show(*store, utcToday());
    nameWithdraw();
}

namespace {

enum CertificateColumn {
    kStanding,
    kDevice,
    kSerial,
    kNumber,
    kLab,
    kDate,
    kDue,
    kFirstU,
    kCertificateColumns = kFirstU + 4
};

/// These columns are hidden first if there is no room for all; a row's tool tip shows everything.
constexpr std::array kDroppedFirst{int(kLab),    kFirstU + 3, kFirstU + 2, int(kDate),
                                   int(kDevice), kFirstU + 1, int(kFirstU)};
constexpr int kMaxRows = 8;  // most visible rows; the rest scrolls
constexpr int kIndexRole = Qt::UserRole;
constexpr int kStandsRole = Qt::UserRole + 1;  // not withdrawn

QString markOf(CertificateState state) {
    switch (state) {
        case CertificateState::Counts:
            return "✔ ";
        case CertificateState::Expired:
        case CertificateState::NotYet:
            return "⚠ ";
        case CertificateState::Superseded:
        case CertificateState::Withdrawn:
            break;
    }
    return "– ";
}

Qt::Alignment alignmentOf(int column) {
    return (column >= kFirstU ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter;
}

}  // namespace

QString figureTitle(const CertificateFigure& figure) {
    return QObject::tr("U %1 (%2)").arg(qtext(figure.title), qtext(figure.unit));
}

CertificateTable::CertificateTable(QWidget* parent) : QTableWidget(0, kCertificateColumns, parent) {
    nameWidget(
        *this, "certificates", QObject::tr("Certificates"),
        QObject::tr("Every certificate that was entered. The one with the latest date is in use; what is entered "
                    "cannot be changed without being noticed."));
    QStringList titles{QObject::tr("State"),       QObject::tr("Instrument"), QObject::tr("Serial"),
                       QObject::tr("Certificate"), QObject::tr("Laboratory"), QObject::tr("Date"),
                       QObject::tr("Due")};
    for (const auto& figure : kCertificateFigures) titles << figureTitle(figure);
    for (int c = kFirstU; c < kCertificateColumns; ++c) titles[c].replace(titles[c].indexOf(' ', 2), 1, '\n');
    setHorizontalHeaderLabels(titles);
    for (int c = 0; c < kCertificateColumns; ++c) horizontalHeaderItem(c)->setTextAlignment(alignmentOf(c));
    setTextSize(*horizontalHeader(), TextSize::Small);
    // Two lines: a title and its unit.
    horizontalHeader()->setMinimumHeight(2 * QFontMetrics(textFont(TextSize::Small)).lineSpacing() + scaledPx(8));
    // The table is as high as its rows, up to a few rows.
    setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Maximum);
    setMaximumHeight(kMaxRows * verticalHeader()->defaultSectionSize());
    makeReadOnly(*this);
    setSelectionBehavior(QAbstractItemView::SelectRows);
    setAlternatingRowColors(true);
    setWordWrap(false);
    setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    horizontalHeader()->setStretchLastSection(true);  // the lines of the table reach its right edge
}

void CertificateTable::show(const CertificateStore& store, CalibrationDate today) {
    setRowCount(0);
    for (std::size_t i = store.all().size(); i-- > 0;) {  // newest entry first
        const auto& [certificate, entered, withdrawn] = store.all()[i];
        const auto state = store.state(i, today);
        QStringList cells{markOf(state) + qtext(nameOf(state)),
                          qtext(certificate.instrument),
                          qtext(certificate.serial),
                          qtext(certificate.number),
                          qtext(certificate.by),
                          qtext(dateText(certificate.date)),
                          qtext(dateText(certificate.due))};
        for (const auto& figure : kCertificateFigures) {
            const auto& u = certificate.*figure.member;
            cells << (u ? QString::number(*u, 'g', 6) : QString("–"));
        }
        QStringList whole;
        for (int column = 0; column < kCertificateColumns; ++column)
            whole << QString("%1: %2").arg(horizontalHeaderItem(column)->text().simplified(), cells[column]);
        const int row = rowCount();
        insertRow(row);
        for (int column = 0; column < kCertificateColumns; ++column) {
            auto* item = new QTableWidgetItem(cells[column]);
            item->setTextAlignment(alignmentOf(column));
            // An unused certificate is grey, and its state says so in words. The window's grey is used, as under the
            // program's style sheet a table's palette has a different one.
            if (state != CertificateState::Counts)
                item->setForeground(window()->palette().brush(QPalette::PlaceholderText));
            item->setToolTip(whole.join('\n'));
            item->setData(kIndexRole, int(i));
            item->setData(kStandsRole, !withdrawn.has_value());
            setItem(row, column, item);
        }
    }
    fitColumns();
    updateGeometry();
}

void CertificateTable::fitColumns() {
    for (int column = 0; column < kCertificateColumns; ++column) setColumnHidden(column, false);
    horizontalHeader()->setStretchLastSection(false);  // a stretched column would take all the remaining width
    resizeColumnsToContents();
    for (const int column : kDroppedFirst) {
        if (horizontalHeader()->length() <= viewport()->width()) break;
        setColumnHidden(column, true);
    }
    horizontalHeader()->setStretchLastSection(true);
}

int CertificateTable::chosen() const {
    const auto rows = selectionModel()->selectedRows();
    if (rows.size() != 1) return -1;
    const auto* cell = item(rows.front().row(), kStanding);
    return cell->data(kStandsRole).toBool() ? cell->data(kIndexRole).toInt() : -1;
}

QString CertificateTable::chosenNumber() const {
    return chosen() < 0 ? QString() : item(selectionModel()->selectedRows().front().row(), kNumber)->text();
}

}  // namespace tacto::gui

#include "moc_CertificateDialog.cpp"
