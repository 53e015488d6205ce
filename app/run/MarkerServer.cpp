#include "app/run/MarkerServer.h"

#include <QEventLoop>
#include <QHostAddress>
#include <QTcpServer>
#include <QTcpSocket>
#include <QThread>
#include <algorithm>
#include <deque>
#include <future>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

constexpr std::chrono::milliseconds kLastLines{200};
constexpr int kTakenUnseen = 16384;  // bytes that the operating system accepts even if a recorder does not read

std::string markerLine(std::uint64_t number, Instant at, std::string_view name) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    const auto ns = std::chrono::nanoseconds(at).count();
    return fmt::format("{} {}.{:09} {}\n", number, ns / kSecond, ns % kSecond, name);
}

/// A connected recorder.
class Recorder {
public:
    explicit Recorder(QTcpSocket* socket) : socket_(socket) {
        socket_->setSocketOption(QAbstractSocket::LowDelayOption, 1);
        socket_->setSocketOption(QAbstractSocket::SendBufferSizeSocketOption, kTakenUnseen);
        socket_->setReadBufferSize(4096);
    }
    ~Recorder() {
        socket_->disconnect();
        socket_->deleteLater();
    }
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Returns false if the line is lost.
    bool offer(const std::string& line) {
        if (socket_->state() != QAbstractSocket::ConnectedState) return false;
        if (socket_->bytesToWrite() + std::int64_t(line.size()) > MarkerServer::kBacklog) return false;
        if (socket_->write(line.data(), qint64(line.size())) != qint64(line.size())) return false;
        offered_ += std::int64_t(line.size());
        ends_.push_back(offered_);
        socket_->flush();
        forgetTaken();
        return true;
    }
    /// Returns the number of lines that the operating system has not accepted.
    [[nodiscard]] std::uint64_t waiting() {
        forgetTaken();
        return ends_.size();
    }
    /// Afterwards waiting() returns the number of lines that were not accepted.
    void hangUp(std::chrono::steady_clock::time_point until) {
        using std::chrono::duration_cast, std::chrono::milliseconds;
        socket_->disconnect();
        while (socket_->bytesToWrite() > 0) {
            const auto left = duration_cast<milliseconds>(until - std::chrono::steady_clock::now()).count();
            if (left <= 0 || !socket_->waitForBytesWritten(int(left))) break;
        }
        forgetTaken();
        static_cast<void>(socket_->readAll());  // else closing discards lines that were sent
        if (socket_->bytesToWrite() == 0)
            socket_->disconnectFromHost();
        else
            socket_->abort();
    }
    [[nodiscard]] QTcpSocket* socket() const { return socket_; }

private:
    void forgetTaken() {
        const auto taken = offered_ - socket_->bytesToWrite();
        while (!ends_.empty() && ends_.front() <= taken) ends_.pop_front();
    }
    QTcpSocket* const socket_;
    std::int64_t offered_ = 0;       // bytes
    std::deque<std::int64_t> ends_;  // where each waiting line ends, in bytes since the start as in offered_
};

}  // namespace

Result<MarkerAddress> MarkerAddress::parse(std::string_view text) {
    const auto refused = [&] {
        return fail(
            ErrorCode::InvalidArgument,
            "markers are to go to \"{}\"; a port from {} to 65535 is expected, or ADDRESS:PORT with an address of "
            "this computer",
            text, kMinPort);
    };
    MarkerAddress made;
    auto port = text;
    if (const auto colon = text.rfind(':'); colon != std::string_view::npos) {
        auto host = text.substr(0, colon);
        port = text.substr(colon + 1);
        if (host.size() > 2 && host.front() == '[' && host.back() == ']')
            host = host.substr(1, host.size() - 2);
        else if (host.find(':') != std::string_view::npos)
            return refused();
        if (host == "localhost") host = "127.0.0.1";
        const QHostAddress address(QString::fromUtf8(host.data(), qsizetype(host.size())));
        if (address.isNull()) return refused();
        made.host = address.toString().toStdString();
    }
    const auto number = parseWhole<std::uint16_t>(port);
    if (!number || *number < kMinPort) return refused();
    made.port = *number;
    return made;
}

std::string MarkerAddress::text() const {
    const bool isLong = host.find(':') != std::string::npos;
    return isLong ? fmt::format("[{}]:{}", host, port) : fmt::format("{}:{}", host, port);
}

nlohmann::json toJson(const MarkerTally& tally) {
    return {{"made", tally.made}, {"unheard", tally.unheard}, {"lost", tally.lost}, {"recorders", tally.recorders}};
}

std::string markersSentence(const MarkerTally& tally) {
    auto said = fmt::format("{} markers were made; ", tally.made);
    if (tally.recorders == 0) return said + "no recorder was connected. The session's record holds each.";
    said += tally.recorders == 1 ? "a recorder connected once"
                                 : fmt::format("recorders connected {} times", tally.recorders);
    if (tally.unheard == 0 && tally.lost == 0) return said + ", and none was lost.";
    if (tally.unheard > 0) said += fmt::format("; {} were made while none was connected", tally.unheard);
    if (tally.lost > 0) said += fmt::format("; {} lines were not taken", tally.lost);
    return said + ". The session's record holds each.";
}

struct MarkerServer::State {
    struct Waiting {
        std::uint64_t number;
        Instant at;
        std::string name;
    };
    void serve(const MarkerAddress& at, std::promise<Result<void>>& listening);
    void accept(QTcpServer& from);
    void greet(Recorder& recorder);
    void left(const QTcpSocket* socket);
    void take();
    void hangUp();

    std::unique_ptr<QThread> thread;
    // Used only by that thread:
    std::vector<std::unique_ptr<Recorder>> recorders;
    std::shared_ptr<const Clock> clock;
    MarkerTally tally;
    std::uint64_t last = 0;  ///< number of the latest marker that was processed

    static constexpr std::size_t kMaxWaiting = 4096;
    std::mutex mutex;
    // Guarded by mutex, held only for moments:
    std::vector<Waiting> waiting;
    std::uint64_t made = 0, dropped = 0;
    QEventLoop* loop = nullptr;  ///< null: the server has ended
};

void MarkerServer::State::serve(const MarkerAddress& at, std::promise<Result<void>>& listening) {
    QTcpServer server;
    QEventLoop serving;
    QObject::connect(&server, &QTcpServer::newConnection, &serving, [&] { accept(server); });
    if (!server.listen(QHostAddress(QString::fromStdString(at.host)), at.port)) {
        const bool taken = server.serverError() == QAbstractSocket::AddressInUseError;
        const auto why = server.errorString().toStdString();
        return listening.set_value(
            taken ? fail(ErrorCode::Io, "markers cannot be sent at {}: another program has that port; choose another",
                         at.text())
                  : fail(ErrorCode::Io, "markers cannot be sent at {} ({}); an address of this computer is expected",
                         at.text(), why));
    }
    {
        const std::scoped_lock lock(mutex);
        loop = &serving;
    }
    listening.set_value({});
    serving.exec();
    take();
    server.close();
    hangUp();
}

void MarkerServer::State::accept(QTcpServer& from) {
    while (auto* socket = from.nextPendingConnection()) {
        if (recorders.size() >= kMaxRecorders) {
            socket->abort();
            socket->deleteLater();
            continue;
        }
        socket->setParent(nullptr);
        recorders.push_back(std::make_unique<Recorder>(socket));
        ++tally.recorders;
        QObject::connect(socket, &QTcpSocket::readyRead, socket, [socket] { static_cast<void>(socket->readAll()); });
        QObject::connect(
            socket, &QTcpSocket::disconnected, socket, [this, socket] { left(socket); },
            Qt::QueuedConnection);  // not while a line is being written to the recorder
        if (clock) greet(*recorders.back());
    }
}

void MarkerServer::State::greet(Recorder& recorder) {
    static_cast<void>(recorder.offer(markerLine(last, clock->now(), "connected")));
}

void MarkerServer::State::left(const QTcpSocket* socket) {
    const auto gone = std::ranges::find(recorders, socket, [](const auto& one) { return one->socket(); });
    if (gone == recorders.end()) return;
    tally.lost += (*gone)->waiting();
    recorders.erase(gone);
}

void MarkerServer::State::take() {
    std::vector<Waiting> taken;
    {
        const std::scoped_lock lock(mutex);
        taken.swap(waiting);
    }
    for (const auto& each : taken) {
        last = each.number;
        if (recorders.empty()) ++tally.unheard;
        const auto line = markerLine(each.number, each.at, each.name);
        for (const auto& recorder : recorders)
            if (!recorder->offer(line)) ++tally.lost;
    }
}

void MarkerServer::State::hangUp() {
    const auto until = std::chrono::steady_clock::now() + kLastLines;
    const auto all = std::exchange(recorders, {});
    for (const auto& each : all) {
        each->hangUp(until);
        tally.lost += each->waiting();
    }
}

MarkerServer::MarkerServer(std::unique_ptr<State> state) : state_(std::move(state)) {}

MarkerServer::~MarkerServer() { static_cast<void>(end()); }

Result<std::unique_ptr<MarkerServer>> MarkerServer::listen(const MarkerAddress& at) {
    std::unique_ptr<MarkerServer> made(new MarkerServer(std::make_unique<State>()));
    auto& state = *made->state_;
    std::promise<Result<void>> listening;
    state.thread.reset(QThread::create([&state, at, &listening] { state.serve(at, listening); }));
    state.thread->start();
    if (auto listens = listening.get_future().get(); !listens) return failure(listens);
    return made;
}

void MarkerServer::begin(std::shared_ptr<const Clock> clock) {
    auto& state = *state_;
    const std::scoped_lock lock(state.mutex);
    if (state.loop == nullptr) return;
    QMetaObject::invokeMethod(
        state.loop,
        [&state, clock = std::move(clock)] {
            state.clock = clock;
            for (const auto& recorder : state.recorders) state.greet(*recorder);
        },
        Qt::QueuedConnection);
}

void MarkerServer::send(Instant at, std::string_view name) {
    auto& state = *state_;
    const std::scoped_lock lock(state.mutex);
    if (state.loop == nullptr) return;
    ++state.made;
    if (state.waiting.size() >= State::kMaxWaiting) {
        ++state.dropped;
        return;
    }
    state.waiting.push_back({state.made, at, std::string(name)});
    if (state.waiting.size() > 1) return;  // the thread has already been told
    QMetaObject::invokeMethod(
        state.loop, [&state] { state.take(); }, Qt::QueuedConnection);
}

MarkerTally MarkerServer::end() {
    auto& state = *state_;
    {
        const std::scoped_lock lock(state.mutex);
        if (auto* loop = std::exchange(state.loop, nullptr))
            QMetaObject::invokeMethod(
                loop, [loop] { loop->quit(); }, Qt::QueuedConnection);
    }
    state.thread->wait();
    auto tally = state.tally;
    tally.made = state.made;
    tally.lost += state.dropped;
    return tally;
}

}  // namespace tacto
