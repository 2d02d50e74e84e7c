// What requests are answered, without sockets.
#include "live/desk.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "live/flights.h"
#include "sensors/display/grey_scale.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;
using nlohmann::json;

namespace {

live::Request get(const std::string& target) {
  return {"GET", target, "localhost:8416", {}, {}, {}};
}

live::Request post(const std::string& target, const std::string& body) {
  return {"POST", target, "127.0.0.1:8416", "http://127.0.0.1:8416", "application/json", body};
}

struct Office {
  tests::TemporaryFolder folder;
  std::unique_ptr<session::Session> session = tests::live_session(folder);
  live::Hub hub;
  live::Desk desk{*session, hub};
};

}  // namespace

TEST_CASE("The status tells one start from another", "[desk]") {
  const Office one, other;
  const auto start = [](const Office& office) {
    return json::parse(office.desk.answer(get("/api/status")).body)["start"].get<std::string>();
  };
  CHECK(start(one) == start(one));
  CHECK(start(one) != start(other));
}

TEST_CASE("The desk answers with the page, the plan and the sensor of the session", "[desk]") {
  const Office office;
  const live::Answer page = office.desk.answer(get("/"));
  CHECK(page.status == 200);
  CHECK(page.body.find("</html>") != std::string::npos);
  const json plan = json::parse(office.desk.answer(get("/api/plan?n=1")).body);
  CHECK(plan["plan"].size() == office.session->scene()->plan.decisions.size());
  const json sensor = json::parse(office.desk.answer(get("/api/sensor")).body);
  CHECK(sensor["columns"] == 164);
  CHECK(sensor["tilt_deg"].get<double>() == Approx(-3.8));
  const json runways = json::parse(office.desk.answer(get("/api/map")).body)["runways"];
  const auto& described = office.session->scene()->description.runways;
  REQUIRE(runways.size() == described.size());
  for (std::size_t i = 0; i < described.size(); ++i) {
    const json& corners = runways[i]["corners"];
    for (std::size_t end : {0U, 1U})  // the ends are in the middle of their corners
      for (std::size_t axis : {0U, 1U}) {
        const core::Geodetic& at = described[i].ends[end].pavement_end;
        const double middle =
            (corners[2 * end][axis].get<double>() + corners[2 * end + 1][axis].get<double>()) / 2.0;
        CHECK(core::radians(middle) ==
              Approx(axis == 0 ? at.latitude_rad : at.longitude_rad).epsilon(0.0).margin(1e-8));
      }
  }
  CHECK(json::parse(office.desk.answer(get("/api/openapi.json")).body)["openapi"] == "3.1.0");
  CHECK(office.desk.answer(get("/frame/bscope.png")).status == 503);
  CHECK(office.desk.answer(get("/../../etc/passwd")).status == 404);
  CHECK(office.desk.answer(get("")).status == 404);
}

// The plan view was turned by it against runways and trail.
TEST_CASE("The sensor tells how far from the nose its azimuths count", "[desk]") {
  for (const double yaw_deg : {0.0, 10.0, -90.0}) {
    const tests::TemporaryFolder folder;
    const auto session = tests::live_session(
        folder, tests::kSmallScene + "\n[sensor]\nyaw_deg = " + std::to_string(yaw_deg) + "\n");
    live::Hub hub;
    const live::Desk desk(*session, hub);
    const json sensor = json::parse(desk.answer(get("/api/sensor")).body);
    CHECK(sensor["mounting_yaw_deg"].get<double>() == Approx(yaw_deg));
  }
}

TEST_CASE("A frame is the PNG of its picture", "[desk]") {
  Office office;
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = 7;
  frame->bscope = {2, 1, {10, 20}};
  frame->cscope = {1, 2, {30, 40}};
  frame->began_s = 1234.5;
  frame->low_dB = -41.0;
  frame->high_dB = 10.0;
  frame->cscope_top_rad = -0.1;
  office.hub.publish(frame);
  const live::Answer answer = office.desk.answer(get("/frame/cscope.png?n=3"));
  CHECK(answer.type == "image/png");
  const auto file = office.folder.path() / "told.png";
  core::write_png(file, frame->cscope, {});
  office.folder.write("answer.png", answer.body);
  CHECK(core::read_image(office.folder.path() / "answer.png").layers.at(0).values ==
        std::vector<double>{30.0, 40.0});
  const std::string message = live::message_of(*frame);
  const std::size_t end = message.find('\n');
  const json head = json::parse(message.substr(0, end));
  CHECK(head["number"] == 7);
  CHECK(head["bscope"] == json({2, 1}));
  CHECK(message.substr(end + 1) == std::string("\x0a\x14\x1e\x28"));
  // Levels and edges are this frame's, whatever the sensor's are by now.
  CHECK(head["low_dB"] == -41.0);
  CHECK(head["began_s"] == 1234.5);
  CHECK(head["high_dB"] == 10.0);
  CHECK(head["cscope_top_deg"].get<double>() == Approx(-0.1 * 180.0 / core::kPi));
  office.folder.write("raised.png", office.desk.answer(get("/frame/cscope.png?gain_dB=10.2")).body);
  CHECK(core::read_image(office.folder.path() / "raised.png").layers.at(0).values ==
        std::vector<double>{30.0 + 51.0, 40.0 + 51.0});
}

// Of a scale of nearly nothing any gain is beyond what an int holds: more made the picture black.
TEST_CASE("Gain beyond the scale makes a picture white, less of it black", "[desk]") {
  live::LiveFrame frame;
  frame.bscope = {2, 1, {0, 200}};
  for (const double scale_dB : {1e-8, 1e-300, 1.0}) {
    frame.high_dB = frame.low_dB + scale_dB;
    CHECK(live::picture_to_show(frame, live::Scope::bscope, 1.0).pixels ==
          std::vector<std::uint8_t>{255, 255});
    CHECK(live::picture_to_show(frame, live::Scope::bscope, -1.0).pixels ==
          std::vector<std::uint8_t>{0, 0});
  }
}

TEST_CASE("A picture that is out of date is crossed out where nothing else tells so", "[desk]") {
  Office office;
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = 8;
  frame->stale = true;
  frame->low_dB = -40.0;
  frame->high_dB = 10.0;
  frame->cscope = {40, 30, std::vector<std::uint8_t>(40 * 30, 255)};
  frame->bscope = {30, 40, std::vector<std::uint8_t>(30 * 40, 0)};
  office.hub.publish(frame);
  // White and black, on white, on black and with any gain, from each corner; the middles of the edges stay.
  for (const char* asked :
       {"bscope.png", "cscope.png", "bscope.png?gain_dB=-60", "cscope.png?gain_dB=60"}) {
    INFO(asked);
    office.folder.write("shown.png", office.desk.answer(get("/frame/" + std::string(asked))).body);
    const core::Image image = core::read_image(office.folder.path() / "shown.png");
    const auto& values = image.layers.at(0).values;
    const int columns = image.columns, rows = image.rows;
    const auto at = [&](int row, int column) {
      return values[static_cast<std::size_t>(row * columns + column)];
    };
    for (const int row : {0, rows - 1})
      for (const int column : {0, columns - 1}) CHECK(at(row, column) == 255.0);
    CHECK(at(0, 3) == 0.0);
    const double ground = at(0, columns / 2);
    CHECK((ground == 0.0 || ground == 255.0));
    CHECK(at(rows / 2, 0) == ground);
    CHECK(at(rows - 1, columns / 2) == ground);
  }
  // What programs read is as it was.
  const std::string message = live::message_of(*frame);
  const std::size_t end = message.find('\n');
  CHECK(json::parse(message.substr(0, end))["stale"] == true);
  CHECK(message.substr(end + 1) == std::string(30 * 40, '\0') + std::string(40 * 30, '\xff'));
  for (const auto& [columns, rows] : {std::pair{0, 0}, {1, 1}, {1, 9}, {9, 1}, {3, 2}}) {
    frame->bscope = {columns, rows,
                     std::vector<std::uint8_t>(static_cast<std::size_t>(columns * rows), 7)};
    CHECK(live::picture_to_show(*frame, live::Scope::bscope).pixels.size() ==
          static_cast<std::size_t>(columns * rows));
  }
  frame->stale = false;
  CHECK(live::picture_to_show(*frame, live::Scope::bscope).pixels == frame->bscope.pixels);
}

// The tilt of the page goes with the levels in force.
TEST_CASE("The sensor, posted back as it is told, stays as it is with any display", "[desk]") {
  for (const char* file : {"hivision.toml", "hivision-seed.toml"}) {
    INFO(file);
    const tests::TemporaryFolder folder;
    const auto session =
        tests::live_session(folder, tests::kSmallScene + "\n[sensor]\nfile = \"" + file + "\"\n");
    live::Hub hub;
    const live::Desk desk(*session, hub);
    const json told = json::parse(desk.answer(get("/api/sensor")).body);
    const sensors::GreyScale grey(session->scene()->description.sensor);
    CHECK(told["low_dB"] == grey.low_dB());
    CHECK(told["high_dB"] == grey.high_dB());
    const json body{{"tilt_deg", -2.0}, {"low_dB", told["low_dB"]}, {"high_dB", told["high_dB"]}};
    const live::Answer answer = desk.answer(post("/api/sensor", body.dump()));
    CHECK(answer.status == 200);
    CHECK(json::parse(answer.body)["tilt_deg"].get<double>() == Approx(-2.0));
    CHECK(json::parse(answer.body)["low_dB"] == told["low_dB"]);
    CHECK(json::parse(answer.body)["high_dB"] == told["high_dB"]);
  }
}

TEST_CASE("Weather and tilt reach the session; what is wrong is told whole and changes nothing",
          "[desk]") {
  const Office office;
  CHECK(
      office.desk.answer(post("/api/weather", R"({"visibility_m": 200, "rain_rate_mm_per_h": 4})"))
          .status == 200);
  CHECK(office.session->scene()->weather.rain_rate_mm_per_h == 4.0);
  CHECK(office.session->scene()->weather.visibility_m == 200.0);
  const live::Answer wrong = office.desk.answer(
      post("/api/weather", R"({"visibility_m": -1, "rain_rate_mm_per_h": "much", "snow": 1})"));
  CHECK(wrong.status == 422);
  CHECK(json::parse(wrong.body)["problems"].size() == 3);
  CHECK(office.session->scene()->weather.rain_rate_mm_per_h == 4.0);
  CHECK(office.desk.answer(post("/api/weather", R"({"rain_rate_mm_per_h": 0})")).status == 200);
  CHECK_FALSE(office.session->scene()->weather.visibility_m.has_value());
  CHECK(office.desk.answer(post("/api/sensor", R"({"tilt_deg": -2})")).status == 200);
  CHECK(office.session->scene()->description.sensor.antenna.boresight_elevation_rad ==
        Approx(-2.0 * core::kPi / 180.0));
  // Neither of two counts, and what is null is there.
  CHECK(office.desk
            .answer(post("/api/weather", R"({"rain_rate_mm_per_h": 1, "rain_rate_mm_per_h": 2})"))
            .status == 422);
  const live::Answer null =
      office.desk.answer(post("/api/weather", R"({"rain_rate_mm_per_h": null})"));
  CHECK(null.status == 422);
  CHECK(json::parse(null.body)["problems"][0]["value"] == "null");
  CHECK(office.session->scene()->weather.rain_rate_mm_per_h == 0.0);
  for (const char* body : {"", "[]", "{", "{\"tilt_deg\": 1e999}", "\xff", "{\"low_dB\": 9}"})
    CHECK(office.desk.answer(post("/api/sensor", body)).status == 422);
  CHECK(office.desk.answer(post("/api/sensor", std::string(60000, '['))).status == 422);
}

// It was obeyed, and the pictures were no longer those that had been recorded.
TEST_CASE("While a recording is flown its own controls are obeyed and no others", "[desk]") {
  const Office office;
  const live::Desk desk(*office.session, office.hub, nullptr, {}, true);
  const std::string rain = R"({"rain_rate_mm_per_h": 9})";
  for (const auto& [path, body] : {std::pair<std::string, std::string>{"/api/weather", rain},
                                   {"/api/sensor", R"({"tilt_deg": -2})"},
                                   {"/api/weather", "nonsense"}}) {
    const live::Answer refused = desk.answer(post(path, body));
    CHECK(refused.status == 409);
    CHECK(json::parse(refused.body)["error"] == "a recording is flown");
  }
  CHECK(desk.answer(post("/api/plan", rain)).status == 404);
  CHECK(desk.answer(get("/api/weather")).status == 200);
  CHECK(office.session->scene()->weather.rain_rate_mm_per_h == 0.0);
  desk.control("/api/weather", rain);
  CHECK(office.session->scene()->weather.rain_rate_mm_per_h == 9.0);
}

TEST_CASE("Another web page cannot steer", "[desk]") {
  const Office office;
  const std::string rain = R"({"rain_rate_mm_per_h": 9})";
  live::Request request = post("/api/weather", rain);
  request.origin = "http://evil.example";
  CHECK(office.desk.answer(request).status == 403);
  request = post("/api/weather", rain);
  request.host = request.origin = "evil.example:8416";  // a name that resolves to this machine
  CHECK(office.desk.answer(request).status == 403);
  request = post("/api/weather", rain);
  request.content_type = "text/plain";  // what a form can send without asking
  CHECK(office.desk.answer(request).status == 415);
  request = post("/api/weather", rain);
  request.method = "PUT";
  const live::Answer other = office.desk.answer(request);
  CHECK(other.status == 405);
  CHECK(other.allow == "GET, HEAD, POST");
  request.target = "/api/status?n=1";
  CHECK(office.desk.answer(request).allow == "GET, HEAD");
  CHECK(office.desk.answer(get("/")).allow.empty());
  CHECK(office.session->scene()->weather.rain_rate_mm_per_h == 0.0);
}

TEST_CASE("A cell's truth is what the layers of the frame that is shown have there", "[desk]") {
  Office office;
  const auto scene = office.session->scene();
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = 5;
  frame->pose = live::circle(*scene)(0.0);
  frame->under = office.session->now();
  frame->scene = office.session->scene();
  office.hub.publish(frame);
  // Conditions that come later do not count.
  office.session->set(session::SensorSettings{.boresight_elevation_rad = -0.3});
  const renderer::Frame made =
      office.session->render(frame->under, frame->pose, 5, {.layers = true, .cscope_layers = true});
  const int columns = 164, rows = 524;
  int seen = 0;
  for (const bool bscope : {true, false})
    for (int row = 3; row < rows; row += 40)
      for (int column = 1; column < columns; column += 40) {
        const renderer::LayerSet& set = bscope ? made.layers->bscope : made.layers->cscope;
        const auto i = static_cast<std::size_t>((bscope ? rows - 1 - row : row) * columns + column);
        const json cell = json::parse(
            office.desk
                .answer(get("/api/cell?scope=" + std::string(bscope ? "bscope" : "cscope") +
                            "&frame=5&column=" + std::to_string(column) +
                            "&row=" + std::to_string(row)))
                .body);
        REQUIRE(cell["gone"] == false);
        REQUIRE(cell["seen"] == (set.visibility[i] > 0.0F));
        if (!cell["seen"]) continue;
        ++seen;
        CHECK(cell["material"] == scene->world.geometry->material_names.at(set.material[i]));
        CHECK(cell["object"] == scene->world.geometry->object_names.at(set.object[i]));
        CHECK(cell["nrcs_dB"].get<double>() ==
              Approx(10.0 * std::log10(static_cast<double>(set.nrcs[i]))));
        CHECK(cell["grazing_deg"].get<double>() ==
              Approx(static_cast<double>(set.grazing_rad[i]) * 180.0 / core::kPi));
      }
  CHECK(seen > 20);
  CHECK(json::parse(office.desk.answer(get("/api/cell?scope=bscope&frame=4&column=1&row=1"))
                        .body)["gone"] == true);
}

// The page steps back through a minute.
TEST_CASE("Frames that are no longer the newest tell their truth, as long as is told", "[desk]") {
  live::Hub brief(0.05);
  Office office;
  const auto scene = office.session->scene();
  const auto publish = [&](live::Hub& hub, std::uint64_t number) {
    auto frame = std::make_shared<live::LiveFrame>();
    frame->number = number;
    frame->pose = live::circle(*scene)(0.0);
    frame->scene = office.session->scene();
    hub.publish(frame);
  };
  publish(brief, 1);
  publish(brief, 2);
  CHECK(brief.origin(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  publish(brief, 3);
  CHECK_FALSE(brief.origin(2));
  CHECK(brief.origin(3));
  for (std::uint64_t number = 1; number <= 1100; ++number) {
    // Sampling is no condition: the pace changes it all the time.
    if (number % 20 == 0) office.session->set(session::Samples{number % 40 == 0 ? 1.0 : 2.0});
    publish(office.hub, number);
  }
  const auto gone = [&](std::uint64_t number) {
    const live::Answer answer = office.desk.answer(
        get("/api/cell?scope=bscope&frame=" + std::to_string(number) + "&column=80&row=300"));
    return json::parse(answer.body)["gone"].get<bool>();
  };
  CHECK_FALSE(gone(1));
  // A target that moves gives each frame conditions of its own, which take memory.
  for (std::uint64_t number = 1101; number <= 1140; ++number) {
    office.session->set(session::SensorSettings{
        .boresight_elevation_rad = -0.03 - 1e-4 * static_cast<double>(number - 1100)});
    publish(office.hub, number);
  }
  CHECK(gone(1107));
  CHECK_FALSE(gone(1108));
  CHECK_FALSE(gone(1140));
}

TEST_CASE("The description has every page of the desk, itself too, and the limits of what is asked",
          "[desk]") {
  const Office office;
  const json api = json::parse(office.desk.answer(get("/api/openapi.json")).body);
  for (const char* path : {"/", "/api/status", "/api/plan", "/api/map", "/api/cell", "/api/weather",
                           "/api/sensor", "/api/openapi.json", "/metrics"}) {
    INFO(path);
    CHECK(api["paths"].contains(path));
    CHECK(office.desk.answer(get(path)).status != 404);
  }
  for (const json& parameter : api["paths"]["/api/cell"]["get"]["parameters"]) {
    const auto name = parameter["name"].get<std::string>();
    if (name == "scope") continue;
    INFO(name);
    const auto status_of = [&](std::int64_t value) {
      std::string target = "/api/cell?scope=bscope";
      for (const char* one : {"frame", "column", "row"})
        target += "&" + std::string(one) + "=" + std::to_string(one == name ? value : 0);
      return office.desk.answer(get(target)).status;
    };
    const auto most = parameter["schema"].at("maximum").get<std::int64_t>();
    CHECK(status_of(parameter["schema"]["minimum"]) == 200);  // gone, as there is no frame
    CHECK(status_of(most) == 200);
    CHECK(status_of(most + 1) == 422);
  }
}

TEST_CASE("A cell that is none is refused with all that is wrong", "[desk]") {
  Office office;
  const live::Answer wrong = office.desk.answer(get("/api/cell?scope=x&frame=-1&column=1e3"));
  CHECK(wrong.status == 422);
  CHECK(json::parse(wrong.body)["problems"].size() == 4);
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = 1;
  frame->pose = live::circle(*office.session->scene())(0.0);
  frame->scene = office.session->scene();
  office.hub.publish(frame);
  const live::Answer beyond =
      office.desk.answer(get("/api/cell?scope=cscope&frame=1&column=164&row=524"));
  CHECK(beyond.status == 422);
  CHECK(json::parse(beyond.body)["problems"].size() == 2);
}

// They were passed over: a picture without the gain that was asked for looked like one with it.
TEST_CASE("Keys of a query that a path has not, or given twice, are told with those it has",
          "[desk]") {
  Office office;
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = 1;
  frame->bscope = {1, 1, {7}};
  frame->high_dB = 10.0;
  office.hub.publish(frame);
  const auto status = [&](const std::string& target) {
    return office.desk.answer(get(target)).status;
  };
  const auto problems = [&](const live::Request& request) {
    const live::Answer answer = office.desk.answer(request);
    CHECK(answer.status == 422);
    return json::parse(answer.body)["problems"];
  };
  const std::string picture = "/frame/bscope.png";
  const json misspelt = problems(get(picture + "?gian_dB=6"));
  REQUIRE(misspelt.size() == 1);
  CHECK(misspelt[0]["field"] == "gian_dB");
  CHECK(misspelt[0]["expected"] == "a key of this path; perhaps gain_dB of gain_dB, n");
  CHECK(problems(get(picture + "?gain_dB=1&gain_dB=500&x")).size() == 2);
  CHECK(problems(get(picture + "?gain_dB=")).size() == 1);
  CHECK(problems(get(picture + "?gain_dB")).size() == 1);
  CHECK(problems(get(picture + "?gain_dB=x&n=1&n=2")).size() == 2);
  CHECK(problems(get("/api/cell?scope=x&frame=1&column=1&row=1&rows=2")).size() == 2);
  CHECK(problems(get("/api/status?token=x")).size() == 1);
  CHECK(problems(post("/api/weather?rain=1", R"({"rain_rate_mm_per_h": 4})")).size() == 1);
  CHECK(office.session->scene()->weather.rain_rate_mm_per_h == 0.0);
  for (const std::string& fine : {picture, picture + "?", picture + "?n=17&gain_dB=6",
                                  std::string("/?token=x"), std::string("/api/plan?n=")})
    CHECK(status(fine) == 200);
  CHECK(status("/nothing?x=1") == 404);
  CHECK(status("/frame/none.png?x=1") == 404);
}

TEST_CASE("What is wrong with values together is told beside those that are wrong alone",
          "[desk]") {
  const Office office;
  using Fields = std::set<std::string>;
  const auto told = [&](const live::Request& request) {
    const live::Answer answer = office.desk.answer(request);
    INFO(answer.body);
    CHECK(answer.status == 422);
    Fields fields;
    const json problems = json::parse(answer.body)["problems"];
    for (const json& problem : problems) fields.insert(problem["field"].get<std::string>());
    return fields;
  };
  const double high_dB = sensors::GreyScale(office.session->scene()->description.sensor).high_dB();
  REQUIRE(high_dB < 100.0);
  CHECK(told(post("/api/sensor", R"({"low_dB": 10, "high_dB": -10, "tilt_deg": -100})")) ==
        Fields{"/tilt_deg", "low_dB, high_dB"});
  CHECK(told(post("/api/weather",
                  R"({"rain_rate_mm_per_h": 5, "snow_rate_mm_per_h": 5, "visibility_m": 3})")) ==
        Fields{"/visibility_m", "snow_rate_mm_per_h"});
  CHECK(told(get("/api/cell?scope=bscope&frame=x&column=1000&row=5000")) ==
        Fields{"frame", "column", "row"});
  // Of values that are wrong alone nothing more is said.
  CHECK(told(post("/api/sensor", R"({"low_dB": 100, "high_dB": -1000})")) == Fields{"/high_dB"});
  CHECK(told(post("/api/weather", R"({"rain_rate_mm_per_h": 5, "snow_rate_mm_per_h": 500})")) ==
        Fields{"/snow_rate_mm_per_h"});
  CHECK(told(get("/api/cell?scope=x&frame=1&column=1000&row=5000")) == Fields{"scope", "column"});
}

// It was said to be perhaps the snow, which was there.
TEST_CASE("Weather without its rain is told with what is there and no likely one", "[desk]") {
  const Office office;
  const live::Answer answer =
      office.desk.answer(post("/api/weather", R"({"snow_rate_mm_per_h": 50})"));
  CHECK(answer.status == 422);
  const json problems = json::parse(answer.body)["problems"];
  REQUIRE(problems.size() == 1);
  CHECK(problems[0]["field"] == "/rain_rate_mm_per_h");
  CHECK(problems[0]["expected"] == "it to be there; there are snow_rate_mm_per_h");
}

// A slider of the page, which posts all it was told, took the fog away.
TEST_CASE("What is told of the weather, posted back, changes nothing", "[desk]") {
  const Office office;
  atmosphere::Weather weather = office.session->scene()->weather;
  weather.visibility_m.reset();
  // Of 4 g/m3 one sees less far than can be posted.
  for (const double water_g_per_m3 : {0.05, 2.0, 4.0}) {
    weather.liquid_water_g_per_m3 = water_g_per_m3;
    office.session->set(weather);
    const std::string told = office.desk.answer(get("/api/weather")).body;
    CHECK(office.desk.answer(post("/api/weather", told)).status == 200);
    CHECK(office.session->scene()->weather.liquid_water_g_per_m3 == water_g_per_m3);
    CHECK(office.desk.answer(get("/api/weather")).body == told);
  }
  json clear = json::parse(office.desk.answer(get("/api/weather")).body);
  clear["visibility_m"] = nullptr;
  CHECK(office.desk.answer(post("/api/weather", clear.dump())).status == 200);
  CHECK_FALSE(atmosphere::has_fog(office.session->scene()->weather));
}

// The page's sliders took the other one away.
TEST_CASE("Where a scene has a melting layer rain and snow may be set together", "[desk]") {
  for (const bool melts : {false, true}) {
    INFO(melts);
    const tests::TemporaryFolder folder;
    const auto session = tests::live_session(
        folder, tests::replaced(tests::kSmallScene, "visibility_m = 400.0\n",
                                melts ? "melting_height_m = 1500.0\n" : "visibility_m = 400.0\n"));
    live::Hub hub;
    const live::Desk desk(*session, hub);
    json told = json::parse(desk.answer(get("/api/weather")).body);
    CHECK(told["melting_layer"] == melts);
    told["rain_rate_mm_per_h"] = 4;
    told["snow_rate_mm_per_h"] = 2;
    CHECK(desk.answer(post("/api/weather", told.dump())).status == (melts ? 200 : 422));
    CHECK(session->scene()->weather.snow_rate_mm_per_h == (melts ? 2.0 : 0.0));
    // It is the scene's, and not set here.
    told["snow_rate_mm_per_h"] = 0;
    told["melting_layer"] = !melts;
    const live::Answer other = desk.answer(post("/api/weather", told.dump()));
    CHECK(other.status == 422);
    CHECK(json::parse(other.body)["problems"][0]["field"] == "/melting_layer");
  }
}
