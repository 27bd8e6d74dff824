"""Small scenes for the tests, as dictionaries that are YAML and messages alike."""
import copy

import genpy.message
from forming_sim.msg import SceneSpec

ALUMINIUM = {
    'density': 2710.0, 'youngs_modulus': 70.5e9, 'poissons_ratio': 0.34,
    'hardening': {'curve': 'voce', 'yield_stress': 192.1e6, 'saturation_stress': 429.8e6, 'rate': 8.504}}


def pulled_strip(duration=2e-5, cells_along=10):
    """A strip in plane strain, pulled at 20 m/s. The standard duration takes far less than a second."""
    return {
        'name': 'pulled strip', 'dimension': 2,
        'bodies': [{
            'name': 'strip',
            'blank': {'shape': 'strip', 'length': 0.010, 'thickness': 0.001, 'cells_along': cells_along, 'cells_through': 2},
            'material': copy.deepcopy(ALUMINIUM),
            'boundaries': [
                {'set': 'left', 'kind': 'fixed', 'axes': ['x']},
                {'set': 'right', 'kind': 'velocity', 'axes': ['x'], 'times': [0.0, 5e-6],
                 'velocities': [[0.0, 0.0, 0.0], [20.0, 0.0, 0.0]]}]}],
        'stages': [{'kind': 'form', 'duration': duration}],
        'output': {'frames': 4}}


def pressed_strip(duration=2e-5):
    """The strip stands on its own; a plane presses on it from above."""
    scene = pulled_strip(duration)
    scene['name'] = 'pressed strip'
    scene['bodies'][0]['boundaries'] = [{'set': 'bottom', 'kind': 'fixed', 'axes': ['y']}]
    scene['tools'] = [{
        'name': 'press', 'point': [0.0, 0.001, 0.0], 'normal': [0.0, -1.0, 0.0],
        'motion': {'kind': 'velocity', 'times': [0.0, 5e-6], 'velocities': [[0.0, 0.0, 0.0], [0.0, -5.0, 0.0]]}}]
    return scene


def long_run():
    """Would take minutes; the strip swings slowly and stays whole."""
    scene = pulled_strip(duration=1.0)
    scene['name'] = 'long run'
    scene['bodies'][0]['boundaries'] = [{'set': 'left', 'kind': 'fixed'}]
    scene['bodies'][0]['initial_velocity'] = [0.1, 0.0, 0.0]
    scene['output'] = {'frames': 1000}
    return scene


def message(scene):
    """The message of a scene: field by field, as in the YAML."""
    spec = SceneSpec()
    genpy.message.fill_message_args(spec, [copy.deepcopy(scene)])
    return spec
