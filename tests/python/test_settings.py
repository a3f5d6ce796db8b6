"""Settings as keyword arguments and objects, and what mistakes in them say."""

import copy
import inspect
import pickle
import typing

import numpy
import pytest
import vitrel

SMALL = {"particles": 50, "packing_fraction": 0.3, "aspect_ratio": 2, "quality_sweeps": 0}


def test_stages_and_species_are_objects():
    species = [vitrel.Species(name="small", fraction=0.5, aspect_ratio=2, size=vitrel.Gaussian(mean=1, standard_deviation=0.1)),
               {"name": "large", "fraction": 0.5, "semi_axes": numpy.array([2, 2])}]
    state = vitrel.prepare(particles=50, packing_fraction=0.4, species=species, quality_sweeps=0,
                           stage=[vitrel.Insert(packing_fraction=0.3), vitrel.Grow(growth_rate=1e-2)])
    assert state.species_names == ["small", "large"] and state.packing_fraction == pytest.approx(0.4)
    read = vitrel.from_toml(state.parameters)
    assert read["prepare"]["stage"] == [vitrel.Insert(packing_fraction=0.3), vitrel.Grow(growth_rate=1e-2)]
    assert read["species"][0].size == vitrel.Gaussian(mean=1.0, minimum=0.1)


def test_objects_are_the_same_as_dictionaries_and_underscores():
    settings = [{"size": vitrel.PowerLaw(low=0.5, high=1.5)},
                {"size": {"distribution": "power_law", "low": 0.5, "high": 1.5}},
                {"species__0__size__distribution": "power_law", "species__0__size__low": 0.5, "size__high": 1.5},
                {"species": [{"aspect_ratio": 2, "size": vitrel.PowerLaw(low=0.5, high=1.5)}], "aspect_ratio": None}]
    states = [vitrel.prepare(**{**SMALL, **setting}) for setting in settings]
    assert all((state.position == states[0].position).all() for state in states)


def test_a_section_leaves_the_others_of_its_keys(tmp_path):
    (tmp_path / "p.toml").write_text("[system]\nparticles = 40\nseed = 5\n", encoding="utf-8")
    state = vitrel.prepare(tmp_path / "p.toml", system={"packing_fraction": 0.2}, quality_sweeps=0)
    assert len(state) == 40 and "seed = 5\n" in state.parameters and state.packing_fraction == pytest.approx(0.2)


def test_the_first_argument_is_a_state_or_a_file(tmp_path):
    (tmp_path / "p.toml").write_text(vitrel.to_toml({"system": {"particles": 40, "packing_fraction": 0.2}}), encoding="utf-8")
    state = vitrel.prepare(tmp_path / "p.toml", quality_sweeps=0)
    state.write(tmp_path / "state.h5")
    for start in (state, tmp_path / "state.h5", str(tmp_path / "state.h5")):
        denser = vitrel.prepare(start, stage=[vitrel.Swell()], packing_fraction=0.3, quality_sweeps=0)
        assert denser.packing_fraction == pytest.approx(0.3)
    assert (vitrel.prepare(start=state).position == state.position).all()
    run = vitrel.run(tmp_path / "p.toml", output=tmp_path / "run.h5", duration=1, equilibration=0, quality_sweeps=0)
    assert (run[0].position == state.position).all()
    with pytest.raises(TypeError, match="give one of them"):
        vitrel.prepare(tmp_path / "p.toml", tmp_path / "p.toml")


@pytest.mark.parametrize("name, meant", [
    ("particle", "particles"), ("species__0__aspct_ratio", "species__0__aspect_ratio"), ("samples__intervl", "samples__interval"),
    ("stages", "stage"), ("sizes_spread", "size_spread"), ("thread", "threads")])
def test_an_unknown_argument_comes_with_the_nearest(name, meant):
    with pytest.raises(TypeError) as mistake:
        vitrel.prepare(**{name: 30})
    assert str(mistake.value) == f"prepare() got an unexpected keyword argument '{name}'; did you mean '{meant}'?"


def test_functions_and_objects_know_their_arguments(tmp_path):
    for function, arguments in [(vitrel.run, {"output": tmp_path / "run.h5", "duraton": 1}), (vitrel.Grow, {"growth_rat": 1}),
                                (vitrel.sweep, {"output": tmp_path, "program": "vitrel", "lader": "seed"}),
                                (vitrel.load, {"path": "run.gsd", "unwarp": "nearest"}), (vitrel.Run.analyze, {"self": None, "onyl": ""}),
                                (vitrel.read, {"path": "run.gsd", "dimenson": 2})]:
        with pytest.raises(TypeError, match=r"\(\) got an unexpected keyword argument '\w+'; did you mean '\w+'\?"):
            function(**arguments)


@pytest.mark.parametrize("settings, message", [
    ({"particles": "many"}, 'particles must be an integer, not the string "many"; for example particles = 1000'),
    ({"stage": [vitrel.Insert(), vitrel.Grow(growth_rate=-1)]},
     "stage[1].growth_rate is -1.0, but must lie above 0 and not above 1, where the surfaces are as fast as the particles"),
    ({"seed": 10**30}, "seed must be an integer, not the number 1e+30; for example seed = 1"),
    ({"stage": {"method": "grow"}}, "stage must be an array of tables, not a table"),
    ({"size_spread": "wide"}, 'size.standard_deviation must be a number, not the string "wide"; for example '
                              'standard_deviation = 0.1'),
    ({"stage": [{"methd": "grow"}]}, "stage[0].methd is unknown; did you mean 'method'? known keys: method, packing_fraction, "
                                     "attempts, orientations"),
    ({"size": vitrel.Uniform(low=2, high=1)}, "size.high is 1.0, but must be above low = 2.0"),
    ({"size_spread": -0.1}, "size.standard_deviation is -0.1, but must be positive"),
    ({"species": [vitrel.Species(aspect_ratio=0.5)], "aspect_ratio": None},
     "species[0].aspect_ratio is 0.5, but must be at least 1.0 and at most 1000000.0"),
    ({"output": {"samples": vitrel.Linear(interval=200)}}, "samples.interval is 200.0, but must not exceed dynamics.duration = 100.0"),
])
def test_a_wrong_value_names_the_argument(settings, message):
    with pytest.raises(vitrel.UserError) as mistake:
        vitrel.prepare(**{**SMALL, **settings})
    assert str(mistake.value) == message


def test_what_is_no_value_is_a_type_error():
    with pytest.raises(TypeError, match="cannot be the value of a parameter"):
        vitrel.prepare(particles=object())


def test_messages_name_no_temporary_file():
    overlapping = vitrel.State.from_arrays([[0, 0], [1.5, 0], [5, 5]], [1, 1], [20, 20])
    with pytest.raises(vitrel.InvariantError, match=r"^start: has 1 overlapping pair.*\(shrink=True, or"):
        vitrel.prepare(overlapping)
    with pytest.raises(vitrel.UserError, match=r"^particles is 5, but that of the state is 3 \(start\)"):
        vitrel.prepare(overlapping, shrink=True, particles=5)


def test_files_are_named_with_their_lines(tmp_path):
    (tmp_path / "p.toml").write_text("[system]\nparticles = 40\nseeds = 5\n", encoding="utf-8")
    with pytest.raises(vitrel.UserError, match=r"p.toml:3:1: key 'system.seeds' is unknown; did you mean 'seed'\?"):
        vitrel.prepare(tmp_path / "p.toml")


def test_a_key_of_a_sweep_is_given_once(tmp_path):
    with pytest.raises(vitrel.UserError, match="seed runs through the values of grid; leave out one of the two"):
        vitrel.sweep(output=tmp_path, program="vitrel", seed=1, grid={"seed": [1, 2]})


def every_object():
    for name in vitrel.parameters.__all__:
        yield getattr(vitrel, name)()


@pytest.mark.parametrize("table", every_object(), ids=lambda table: type(table).__name__)
def test_objects_are_toml_and_back(table):
    assert type(table).from_toml(table.to_toml()) == table == copy.deepcopy(table) == pickle.loads(pickle.dumps(table))
    changed = {name: 7.5 for name, hint in typing.get_type_hints(type(table)).items() if hint == typing.Optional[float]}
    other = type(table)(**changed)
    assert type(table).from_toml(other.to_toml()) == other and (not changed or other != table)
    assert type(table).__doc__ and all(f"\n    {name}: " in type(table).__doc__ for name in inspect.signature(type(table)).parameters)


def test_objects_refuse_another_form():
    with pytest.raises(vitrel.UserError, match="method is 'insert', but that of Grow is 'grow'"):
        vitrel.Grow.from_toml('method = "insert"')


def test_a_parameter_file_becomes_arguments_and_back():
    text = vitrel.prepare(**SMALL, dynamics={"driving": vitrel.Driving(power=2)}).parameters
    settings = vitrel.from_toml(text)
    assert settings["dynamics"]["driving"] == vitrel.Driving(power=2.0)
    assert vitrel.from_toml(vitrel.to_toml(settings)) == settings
    assert vitrel.prepare(**settings).parameters == text
