function outputs = tried(controller, inputs, outputs)
%VERP.TRIED A controller's outputs, or its error text. Used by verp.Session, because Octave does
% not report the exception of a function that the library calls.
  try
    outputs = controller(inputs, outputs);
  catch thrown
    outputs = thrown.message;
  end
end
