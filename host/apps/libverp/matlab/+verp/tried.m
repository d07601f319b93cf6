function outputs = tried(controller, inputs, outputs)
%VERP.TRIED What a controller puts out, or the words of its error. For verp.Session: what a call back
% from the library throws, Octave does not tell it.
  try
    outputs = controller(inputs, outputs);
  catch thrown
    outputs = thrown.message;
  end
end
