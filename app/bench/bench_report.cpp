#include "app/bench/bench_report.h"

#include "engine/core/number_text.h"
#include "engine/core/read_file.h"
#include "engine/edit/json_reader.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace anvil {

namespace {

using Json = nlohmann::ordered_json;

constexpr uint64_t shown_memory = uint64_t{64} << 20; // bytes; smaller cases fit anywhere

std::string left(std::string text, size_t width) {
    text.resize(std::max(width, text.size() + 1), ' ');
    return text;
}

std::string right(const std::string& text, size_t width) {
    return std::string(text.size() < width ? width - text.size() : 1, ' ') + text;
}

/// Three significant digits.
std::string short_text(double x) {
    char buffer[32];
    const auto format = x >= 100 && x < 1e7 ? std::chars_format::fixed : std::chars_format::general;
    const auto end =
        std::to_chars(buffer, buffer + sizeof buffer, x, format, x >= 100 && x < 1e7 ? 0 : 3).ptr;
    return {buffer, end};
}

std::string row_of(const std::string& name, const std::string& vertices, const std::string& region,
                   const std::string& median, const std::string& least, const std::string& most,
                   const std::string& bandwidth, const std::string& ratios) {
    return left(name, 42) + right(vertices, 8) + right(region, 9) + right(median, 10) + right(least, 10) +
           right(most, 10) + right(bandwidth, 8) + "  " + ratios + "\n";
}

Json machine_json(const Machine& m) {
    return {{"cpu", m.cpu},
            {"cores", m.cores},
            {"memory_bytes", m.memory_bytes},
            {"system", m.system},
            {"load", m.load},
            {"device", m.device},
            {"driver", m.driver},
            {"anvil", m.version},
            {"compiler", m.compiler},
            {"float_loop", m.float_loop}};
}

Json case_json(const BenchResult& r) {
    Json ratio = Json::object();
    for (const auto& [yardstick, number] : r.ratios) {
        ratio[yardstick] = number;
    }
    Json json = {{"name", r.name},
                 {"vertices", r.vertices},
                 {"region", r.region},
                 {"samples", r.timing.samples},
                 {"median_s", r.timing.median_s},
                 {"min_s", r.timing.min_s},
                 {"max_s", r.timing.max_s},
                 {"bytes", r.bytes},
                 {"device_bytes", r.device_bytes},
                 {"ratio", ratio}};
    if (r.error) {
        json["step_error"] = {{"rms", r.error->rms}, {"worst_of_99_percent", r.error->worst_of_99}};
    }
    return json;
}

BenchResult read_case(const JsonReader& from, const nlohmann::json& document) {
    BenchResult result;
    result.name = from.required("name").text();
    result.timing.median_s = from.required("median_s").positive();
    const JsonReader ratio = from.required("ratio");
    for (const auto& [yardstick, number] : document.at("ratio").items()) {
        result.ratios.emplace_back(yardstick, ratio.required(yardstick).positive());
    }
    return result;
}

} // namespace

std::string table_head(const Machine& m) {
    return "device:  " + m.device + " (" + m.driver + ")\nmachine: " + m.cpu + ", " +
           std::to_string(m.cores) + " cores, load " + short_text(m.load) + "; " + m.system + "; " +
           m.compiler + "\n" +
           row_of("case", "vertices", "region", "median ms", "min", "max", "GB/s",
                  "time over that of the yardstick");
}

std::string table_row(const BenchResult& r) {
    std::string ratios;
    for (const auto& [yardstick, number] : r.ratios) {
        ratios += (ratios.empty() ? "" : "  ") + yardstick + " " + short_text(number);
    }
    if (r.error) {
        ratios += "  (off by " + short_text(r.error->rms) + " rms, 99 % by " +
                  short_text(r.error->worst_of_99) + " of the diagonal)";
    }
    if (r.device_bytes >= shown_memory) {
        ratios += "  (" + std::to_string(r.device_bytes >> 20) + " MiB on the device)";
    }
    return row_of(r.name, std::to_string(r.vertices), std::to_string(r.region),
                  short_text(1e3 * r.timing.median_s), short_text(1e3 * r.timing.min_s),
                  short_text(1e3 * r.timing.max_s),
                  short_text(1e-9 * static_cast<double>(r.bytes) / r.timing.median_s), ratios);
}

std::string bench_json(const BenchRun& run) {
    Json json = {{"machine", machine_json(run.machine)},
                 {"quick", run.quick},
                 {"clock", run.clock == BenchClock::wall ? "wall" : "processor"},
                 {"cases", Json::array()}};
    for (const BenchResult& result : run.results) {
        json["cases"].push_back(case_json(result));
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

BenchRun read_bench_json(const std::string& path) {
    const nlohmann::json document = parse_json(read_file(path), path);
    const JsonReader top(document, path);
    BenchRun run;
    const JsonReader machine = top.required("machine");
    run.machine.cpu = machine.required("cpu").text();
    run.machine.device = machine.required("device").text();
    run.clock = top.required("clock").word<BenchClock>(
        {{"wall", BenchClock::wall}, {"processor", BenchClock::processor}});
    const std::vector<JsonReader> cases = top.required("cases").items();
    for (size_t i = 0; i < cases.size(); ++i) {
        run.results.push_back(read_case(cases[i], document.at("cases").at(i)));
    }
    return run;
}

} // namespace anvil
